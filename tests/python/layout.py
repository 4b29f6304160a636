"""Writes C that does not compile unless each struct of the package has the size and the members that C sees.

    python layout.py OUT.c
"""
import ctypes
import sys

from vndf import _library

NAMES = [name for name in vars(_library) if name.startswith("vndf_")]

sys.stdout = open(sys.argv[1], "w")
print("#include <stddef.h>\n#include <vndf.h>\n#include <vndf_bsdf.h>\n#include <vndf_build.h>")
for name in NAMES:
    struct = getattr(_library, name)
    print(f'_Static_assert(sizeof({name}) == {ctypes.sizeof(struct)}, "{name}");')
    for member, *_ in struct._fields_:
        offset = getattr(struct, member).offset
        size = getattr(struct, member).size
        place = f"offsetof({name}, {member}) == {offset} && sizeof((({name} *)0)->{member}) == {size}"
        print(f'_Static_assert({place}, "{name}.{member}");')
print(f"int structs = {len(NAMES)};")
