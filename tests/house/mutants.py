"""A test of the tests: mutants.py SOURCE BUILD OUT [all]

Each defect of mutants.txt, planted in a copy of its file, makes the test fail that is named for it. A defect that
survives is a gap in the suite. A text that is no longer found exactly once is an error too: the list has to follow the
sources. Planted are the defects that are marked `(always)`; with `all`, all of them.

Nothing is built twice: of the objects that the test's program takes from this build, those that depend on the file are
compiled with the defect, and linked before the sound ones."""
import json
import os
import re
import shutil
import subprocess
import sys

source, build, out = sys.argv[1:4]
every = sys.argv[4:] == ["all"]


def run(line, folder, seconds=None, **environment):
    """Status and text of a line for the shell."""
    try:
        done = subprocess.run(line, shell=True, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              timeout=seconds, errors="replace", env={**os.environ, **environment})
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        return 1, "it takes too long"


def read(path):
    with open(path) as file:
        return file.read()


def link(folder, target, options):
    """A program of the build's folder as OUT/TARGET; of two definitions the first one counts."""
    line = read(f"{folder}/CMakeFiles/{target}.dir/link.txt").strip()
    more = f" -o {out}/{target} -Wl,--allow-multiple-definition {options} "
    return run(re.sub(r" -o \S+ ", lambda _: more, line, count=1), folder)


members = {}  # of a program: the names of the objects that it is linked of


def build_mutant(folder, target, changed):
    """Compiles what depends on the changed file, OUT/copy before the sources, and links. None where nothing depends on
    it; else status and text."""
    if target not in members:
        members[target] = set(re.findall(r"[^ /()\n]+\.c\.o", link(folder, target, "-Wl,-M")[1]))
    objects = []
    for object, line in compilations.items():
        if os.path.basename(object) not in members[target] or f"/{changed}" not in read(object + ".d"):
            continue
        objects.append(f"{out}/{re.sub('[^a-z0-9]', '_', object)}.o")
        line = line.replace(f" -c {source}/{changed}", f" -c {out}/copy/{changed}")
        line = re.sub(f"-I{source}/(src|include|tools|tests) ", rf"-I{out}/copy/\1 \g<0>", line)
        status, text = run(re.sub(r" -o \S+ ", f" -O1 -w -o {objects[-1]} ", line), build)
        if status:
            return status, text
    return link(folder, target, " ".join(objects)) if objects else None


passes = {}  # of a test: whether it does without a defect


def line_of(test, folder):
    """What runs a test, which is words: "walk 0" is the program test_walk of the folder with the argument 0,
    "python_formats Bench" a script, which asks the program alone."""
    name, _, rest = test.partition(" ")
    script = f"{sys.executable} {source}/tests/python/test_{name[7:]}.py {rest}"
    return script if name.startswith("python_") else f"{folder}/test_{test}"


def plant(test, changed, unsound):
    """What is wrong with the test."""
    environment = {"VNDF_TEST_QUICK": "1", "VNDF_SOURCE": source, "VNDF_PROGRAM": f"{build}/vndf"}
    if test not in passes:
        passes[test] = run(line_of(test, f"{build}/tests"), out, 120, **environment)[0] == 0
    if not passes[test]:
        return f"'{test}' fails without it"
    copy, target = f"{out}/copy/{changed}", f"test_{test.split()[0]}"
    os.makedirs(os.path.dirname(copy))
    with open(copy, "w") as file:
        file.write(unsound)
    compiled = [line for object, line in compilations.items() if object.endswith(f"/{target}.c.o")]
    built = [build_mutant(f"{build}/tests", target, changed) if compiled else None]
    environment["VNDF_TEST_FIRST"] = "1"
    if not compiled or "-DVNDF_PROGRAM=" in compiled[0]:
        built.append(build_mutant(build, "vndf_program", changed))
        environment["VNDF_PROGRAM"] = f"{out}/vndf_program"
    shutil.rmtree(f"{out}/copy")
    wrong = [text for status, text in filter(None, built) if status]
    if wrong or not any(built):
        return "it cannot be built:\n" + "".join(wrong)
    status, text = run(line_of(test, out if built[0] else f"{build}/tests"), out, 120, **environment)
    skipped = re.search("SKIPPED: .*", text)
    print(f"{skipped[0] if skipped else 'noticed' if status else 'SURVIVES'}: {test}", flush=True)
    return None if status or skipped else f"it survives; '{test}' passes, where it has to fail"


if not os.path.exists(f"{build}/tests/CMakeFiles/test_invert.dir/link.txt"):
    print("SKIPPED: only builds by make tell how their programs are compiled and linked")
    sys.exit()
shutil.rmtree(out, ignore_errors=True)
os.makedirs(out)
compilations = {}  # of an object: the line that compiles it
for entry in json.loads(read(f"{build}/compile_commands.json")):
    made = re.search(r" -o (\S+\.c\.o) -c ", entry["command"])
    if made:
        compilations[f"{entry['directory']}/{made[1]}"] = entry["command"]

blocks = read(f"{source}/tests/house/mutants.txt").rstrip("\n").split("\n\n")[1:]
failures = [] if len(blocks) >= 40 else [f"mutants.txt: {len(blocks)} defects are read"]
for block in blocks:
    form = re.fullmatch(r"([^\n:(,]+)( \(always\))?, ([^:\n]+): ([^\n]+)\n- ([^\n]+)\n\+ ([^\n]+)", block)
    if not form:
        failures.append(f"mutants.txt: this is no defect:\n{block}")
        continue
    test, always, name, what, old, new = form.groups()
    sound = read(f"{source}/{name}")
    if sound.count(old) != 1:
        failures.append(f"mutants.txt: '{what}' does not find exactly once in {name}:\n  {old}")
    elif every or always:
        wrong = plant(test, name, sound.replace(old, new))
        failures += [f"'{what}': {wrong}"] if wrong else []
sys.exit("\n".join(failures) or 0)
