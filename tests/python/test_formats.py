"""What the program writes is what its format says, by the readers that Python has: JSON has the figures of the text,
pages close their tags and ask for nothing from elsewhere, a PNG has the numbers of the PFM, a baked table has the
same ones in all its forms, and the rows of `vndf bench` are those that are asked for, with every number. Times
themselves are not judged. It notices a figure without a unit, a tag that stays open, a checksum that is wrong, a
number that is another in another form, a row too many, a column that is lost, a batch that is not timed."""
import array
import ast
import csv
import filecmp
import html.parser
import json
import os
import re
import shutil
import struct
import subprocess
import unittest
import xml.etree.ElementTree
import zlib


def run(*words, status=0):
    done = subprocess.run([os.environ["VNDF_PROGRAM"], *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)
    assert done.returncode == status, words
    return done.stdout.decode()


class Figures(unittest.TestCase):
    def same(self, name, keys):
        figures, lines = json.loads(run("info", name, "--json")), run("info", name).splitlines()
        for line in lines:
            key, text = line.split(" ", 1)
            value, unit = figures[key], figures["units"].get(key)
            if key != "knot":
                said = {True: "yes", False: "no"}[value] if isinstance(value, bool) else value
                number = text.split(" ")[0] if isinstance(value, (int, float)) else text
                self.assertTrue(number == said or float(number) == value, line)
                self.assertEqual(text, f"{number} {unit}" if unit else number)
        self.assertLessEqual(set(keys.split()), {line.split(" ")[0] for line in lines})
        self.assertEqual(run("info", name, "-q"), "")

    def test_text_and_json_say_the_same(self):
        run("build", "--slope", "exp(-k*r)", "--set", "k=2", "--max-bytes", "2048", "-q", "-o", "t")
        run(*"build --family student-t --parameter 1.8..3 --knots 2 --max-bytes 2048 -q -o two.vndfs".split())
        self.same("ggx", "tool bytes memory cells moments normalization scale")
        self.same("t", "tv tv_theta tv_above tv_above_theta max_weight weight_bounded area_error consistency ndf_error "
                  "hidden finest horizon_power floor_above floor verdict")
        self.same("two.vndfs", "knots low high linear_in distance grazing tables_tv knot verdict")
        checked = json.loads(run(*"check t --samples 20000 --hard --json".split()))
        self.assertEqual((checked["chi_square"][0]["theta"], checked["result"]), (0, "good"))
        self.assertIn("facing", [row.get("of") for rows in checked.values() if isinstance(rows, list) for row in rows])


class Page(html.parser.HTMLParser):
    """Every tag is closed in its order, every attribute has a value."""

    open = ()

    def handle_starttag(self, tag, attributes):
        assert all(value is not None for _, value in attributes), attributes
        self.open += () if tag in ("meta", "br", "link", "input", "img") else (tag,)

    def handle_endtag(self, tag):
        assert self.open[-1] == tag, (self.open, tag)
        self.open = self.open[:-1]


class Pages(unittest.TestCase):
    def well_formed(self, name):
        with open(name) as file:
            text, page = file.read(), Page()
        page.feed(text)
        self.assertEqual(page.open, ())
        self.assertNotRegex(text, "<script|src=.?[a-z]+:|url[(]|@import|>nan<|nan\"|nan ")
        return text

    def test_reports(self):
        """Of a D with a jump, whose advice is what `vndf build` makes, and of a CSV with a name that has to be escaped,
        which replaces the page and leaves what others put beside it."""
        jump = ["--ndf", "step(c-0.5)*(1+theta)"]
        shutil.copy(os.path.join(os.environ["VNDF_SOURCE"], "tables", "example.csv"), "a&<b>.csv")
        for words in (jump, ["--csv", "a&<b>.csv", "--with", "beckmann"]):
            said = run("report", *words, "--seconds", "1", "page")
            self.assertIn("page/index.html\n" if words is jump else "replaced the report in ", said)
            text = self.well_formed("page/index.html")
            for part in ("<!DOCTYPE html>\n", ": ship ", '<tr class="chosen"><td>',
                         '<tr class="group"><th class="text" colspan="9">',
                         *(f'<h2 id="{name}">' for name in ("advice", "frontier", "time", "normals")),
                         *(f'href="{name}"' for name in ("tables.csv", "methods.csv", "frontier.svg"))):
                self.assertIn(part, text)
            with open("page/frontier.svg") as file:
                svg = file.read()
            xml.etree.ElementTree.fromstring(svg)
            self.assertIn(">advised</text>", text)
            ticks = re.search(r'end"><tspan x="[^"]*" y="(.*?)">[^<]*</tspan><tspan x="[^"]*" y="(.*?)"', svg)
            self.assertGreater(float(ticks[1]), float(ticks[2]) + 1)  # of an axis that goes up
            with open("page/tables.csv") as file:
                tables = list(csv.DictReader(file))
            if words is jump:
                bytes_built = re.search("\nbytes ([0-9]+) ", run("build", *jump, "-o", "built"))[1]
                self.assertIn((bytes_built, "4"), [(row["file (bytes)"], row["moments"]) for row in tables])
                self.assertEqual(len(os.listdir("page")), 4)
                open("page/note.txt", "w").close()
        self.assertEqual(len(os.listdir("page")), 5)


class Tables(unittest.TestCase):
    def test_baked(self):
        """The numbers of a .npy stand in every other form, as halves in a .dds; the same bytes twice; a page and a
        verdict, which doubts what is far off: no transformed cosine resembles a ring of light."""
        words = "bake ggx --what dfg,prefilter --size 8".split()
        self.assertIn("largest error", run(*words, "-o", "one"))
        told = json.loads(run(*words, "--json", "-o", "two"))
        self.assertEqual([table["name"] for table in told["table"]], ["dfg", "prefilter"])
        self.assertEqual(filecmp.cmpfiles("one", "two", sorted(os.listdir("one")), False)[0], sorted(os.listdir("two")))
        self.assertEqual(len(os.listdir("two")), 13)
        for name, shape in (("dfg", (8, 8, 3)), ("prefilter", (8, 32, 4))):
            with open(f"one/{name}.npy", "rb") as npy, open(f"one/{name}.dds", "rb") as dds:
                data, pixels = npy.read(), dds.read()
            size = struct.unpack("<H", data[8:10])[0]
            self.assertEqual(data[:8], b"\x93NUMPY\1\0")
            head = ast.literal_eval(data[10 : 10 + size].decode())
            self.assertEqual(head, dict(descr="<f4", fortran_order=False, shape=shape))
            values, halves = array.array("f", data[10 + size :]), pixels[148:]
            self.assertEqual((pixels[:4], len(halves)), (b"DDS ", 8 * shape[0] * shape[1]))
            for i, value in enumerate(values):
                at = i // shape[2] * 8 + i % shape[2] * 2
                self.assertEqual(halves[at : at + 2], struct.pack("<e", value))
            self.assertEqual(halves[6:8] == b"\0\x3c", shape[2] == 3)  # where there is no fourth, it is 1
            for ending, head in (("h", "static const float %s[%d] = {"), ("glsl", "const float %s[%d] = float[%d](")):
                with open(f"one/{name}.{ending}") as file:
                    text = file.read()
                self.assertIn("// made by: vndf bake ggx --what dfg,prefilter --size 8", text)
                numbers = text.split(head % (name, len(values), len(values))[: head.count("%")])[1]
                self.assertEqual(array.array("f", map(float, re.findall(r"-?[0-9][-+.e0-9]*", numbers))), values)
        self.assertIn("dfg.png", Pages.well_formed(self, "one/index.html"))
        if shutil.which("glslangValidator"):
            frag = os.path.join(os.environ["VNDF_SOURCE"], "tools", "bake", "examples", "haze.frag")
            subprocess.run(["glslangValidator", frag], check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(run(*"bake ggx --what ltc --size 4 --format js -o one -q".split()), "")
        hazy = os.path.join(os.environ["VNDF_SOURCE"], "tables", "hazy.vndf")
        told = run("bake", hazy, *"--what ltc --size 8 --format npy -o haze".split())
        self.assertIn("\nverdict good to ship\n", told)
        self.assertEqual(len(os.listdir("haze")), 5)
        run("build", "--slope", "exp(-3*r)*(1+0.8*cos(6*r))", "-q", "-o", "rings.vndf")
        doubt = run(*"bake rings.vndf --what ltc --size 8 --format npy -o rings".split()).splitlines()[-1]
        self.assertRegex(doubt, "^verdict doubtful: ltc_inverse is 0.3[0-9]* off in the mean, ")


class Images(unittest.TestCase):
    def chunks(self, data):
        at = 8
        while at < len(data):
            (size,) = struct.unpack(">I", data[at : at + 4])
            body, at = data[at + 4 : at + 8 + size], at + 12 + size
            self.assertEqual(zlib.crc32(body), struct.unpack(">I", data[at - 4 : at])[0])
            yield body[:4], body[4:]

    def test_png(self):
        for width, height in ((300, 200), (131, 7), (1, 1)):  # the first in three blocks
            with open("a.scene", "w") as scene:
                scene.write(f"camera --from 0,0,5 --to 0,0,0 --width {width} --height {height}\n"
                            "environment --image studio\nmaterial m --conductor gold --distribution ggx --alpha 0.2\n"
                            "sphere --centre 0,0,0 --radius 1 --material m\n")
            for name in ("a.png", "a.pfm"):
                run("render", "a.scene", "--spp", "1", "-q", "-o", name)
            with open("a.png", "rb") as png, open("a.pfm", "rb") as pfm:
                data, floats = png.read(), array.array("f", pfm.read()[-12 * width * height :])
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            (kind, head), *parts, end = self.chunks(data)
            self.assertEqual((kind, struct.unpack(">IIBBBBB", head)), (b"IHDR", (width, height, 8, 2, 0, 0, 0)))
            self.assertEqual(({kind for kind, _ in parts}, end), ({b"IDAT"}, (b"IEND", b"")))
            bytes_of_all, row = zlib.decompress(b"".join(part for _, part in parts)), 3 * width
            self.assertEqual(len(bytes_of_all), (row + 1) * height)
            for y in range(height):
                line = bytes_of_all[(row + 1) * y : (row + 1) * (y + 1)]
                self.assertEqual(line[0], 0)  # no filter
                for byte, x in zip(line[1:], floats[row * (height - 1 - y) :]):
                    x = min(max(x, 0), 1)
                    encoded = 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055
                    self.assertLess(abs(byte - 255 * encoded), 1)


class Bench(unittest.TestCase):
    HEAD = ("distribution,method,kind,alpha_x,alpha_y,memory,file_bytes,moments,wrong,ns,portable_ns,avx2_ns,avx512_ns,"
            "shared_ns,eval_ns,pdf_ns,spread,ratio,tv,tv_below,max_weight,stratified,efficiency_60,efficiency_85,"
            "efficiency_light,mean,noise,lost,variance,efficiency").split(",")

    def rows(self, *words):
        """With numbers for numbers, None for nothing; all are right and timed."""
        head, *lines = csv.reader(run("bench", *words, "-o", "-").splitlines())
        self.assertEqual(head, self.HEAD)
        rows = [{k: x if k in head[:3] else float(x) if x else None for k, x in zip(head, line)} for line in lines]
        for line, row in zip(lines, rows):
            self.assertTrue(len(line) == len(head) and row["wrong"] == 0 and row["ns"] > 0, line)
            self.assertTrue(row["kind"] != "call" or row["tv"] is None, line)  # which is timed alone
        return rows

    def test_normals(self):
        rows = self.rows(*"--seconds 0.1 --only ggx".split())
        self.assertEqual([row["method"] for row in rows],
                         ["spherical caps (2023)", "all normals (2007)", "closed form", "closed form: 16 a view",
                          "closed form: affine", "closed form: mixture", "closed form: 8 lobes",
                          "closed form, exported C"])
        caps = rows[0]
        self.assertTrue(caps["ratio"] == 1 and caps["tv"] < 1e-6 and caps["portable_ns"] > 0 and caps["memory"] == 0)
        table, words = "table 8 KiB, 4 moments", ["--slope", "exp(-a*r)", "--set", "a=3"]
        rows = self.rows("--seconds", "0.1", *words, "--only", table)
        self.assertEqual([row["method"][len(table) :] for row in rows],
                         ["", ": weight", ": pdf", ": invert", ": ndf", ": lambda", ": 16 a view", ": affine",
                          ": mixture", ": 8 lobes", ", exported C"])
        row = rows[0]
        self.assertEqual((row["distribution"], row["moments"]), ("--slope 'exp(-a*r)' --set a=3", 4))
        self.assertTrue(row["memory"] > row["file_bytes"] > 7900 and row["portable_ns"] > 0 and row["max_weight"] > 1)
        self.assertTrue(row["tv_below"] > row["tv"] and abs(row["tv"] - 2.44e-4) < 2e-5)
        self.assertTrue(0.1 < row["stratified"] < 1.6)  # of caps

    def test_effects(self):
        rows = self.rows(*"--effects --seconds 0.01 --only masking --alpha 0.3,0.2".split())
        self.assertEqual([(row["distribution"], row["method"]) for row in rows],
                         [(d, m + " masking") for d in ("ggx", "beckmann", "student-t:2.5")
                          for m in ("separable", "V-cavity", "no")])
        self.assertTrue((rows[0]["alpha_x"], rows[0]["alpha_y"]) == (0.3, 0.2) and rows[0]["portable_ns"] > 0)
        rows = self.rows(*"--effects --seconds 0.01".split())
        self.assertEqual((len(rows), "walk, both lobes" in [row["method"] for row in rows]), (3 * 24 + 1, True))
        for before, row in zip([None, *rows], rows):
            if row["method"] == "bare reflection, by hand":
                self.assertAlmostEqual(row["mean"] / before["mean"], 1, 5)
            is_table, is_bounded = row["distribution"] == "student-t:2.5", row["method"].startswith("bounded")
            most_lost = 1 if not is_bounded else 0 if is_table else 0.06
            self.assertTrue(0 < row["mean"] < 2.25 and row["lost"] <= most_lost, row)
            if is_bounded or row["method"].startswith("bare"):
                self.assertLessEqual(row["max_weight"], 1.3 if is_table else 1.00001, row)

    def test_tables(self):
        """Text and Markdown leave out columns without a number, and -q prints nothing."""
        text = run(*"bench --seconds 0.1 --only moments -o rows.md".split())
        self.assertLessEqual(max(map(len, text.splitlines())), 100)
        self.assertTrue("  table 2 KiB, 4 moments " in text and "caps (2023)" not in text and "eval" not in text)
        with open("rows.md") as file:
            markdown = file.read()
        self.assertIn("| student-t:2.5 | table 8 KiB, 4 moments | ", markdown)
        self.assertIn(" | ratio | TV | below | weight | Sobol' | eff 60 |", markdown)
        self.assertNotIn("| eval |", markdown)
        self.assertEqual(run(*"bench --only caps --seconds 0.1 -q".split()), "")
        (row,) = json.loads(run(*"bench --only caps --seconds 0.1 --json".split()))
        self.assertEqual((row["kind"], row["alpha_x"], row["memory"]), ("published", None, 0))


if __name__ == "__main__":
    unittest.main()
