"""Puts into the package the C library, its headers, and its kernel in Python, which vndf.mitsuba runs: the files that
the environment variables VNDF_LIBRARY and VNDF_KERNEL name, or what CMake builds from the checkout around this folder.
pyproject.toml has everything else."""
from __future__ import annotations

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = pathlib.Path(os.environ.get("VNDF_SOURCE", HERE.parents[1]))
NAME = {"win32": "vndf.dll", "darwin": "libvndf.dylib"}.get(sys.platform, "libvndf.so")
if not (SOURCE / "include" / "vndf.h").exists():
    raise SystemExit(f"{SOURCE} is not the checkout of vndf; name it in VNDF_SOURCE")


def build(folder: pathlib.Path) -> tuple[pathlib.Path, pathlib.Path]:
    """Library and kernel, in a folder outside the checkout: what CMake leaves would be sources under tools/."""
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DVNDF_BUILD_TESTS=OFF"]
    subprocess.run(["cmake", "-S", SOURCE, "-B", folder, *options], check=True)
    target = ["--config", "Release", "--parallel", str(os.cpu_count()), "--target", "vndf", "vndf_kernel"]
    subprocess.run(["cmake", "--build", folder, *target], check=True)
    return next(folder.rglob(NAME)), folder / "exported" / "_kernel.py"


class BuildWithLibrary(build_py):
    def run(self) -> None:
        super().run()
        package = HERE / "vndf" if self.editable_mode else pathlib.Path(self.build_lib) / "vndf"
        given = os.environ.get("VNDF_LIBRARY"), os.environ.get("VNDF_KERNEL")
        with tempfile.TemporaryDirectory() as folder:
            library, kernel = given if all(given) else build(pathlib.Path(folder))
            shutil.copyfile(library, package / NAME)
            shutil.copyfile(kernel, package / "_kernel.py")
        if not self.editable_mode:  # they are found in the checkout
            headers = shutil.ignore_patterns(".*", "*.hpp")
            shutil.copytree(SOURCE / "include", package / "include", ignore=headers, dirs_exist_ok=True)


class WithLibrary(Distribution):
    """Of this platform alone."""

    def has_ext_modules(self) -> bool:
        return True


version = re.search(r'VNDF_VERSION "(.*)"', (SOURCE / "include" / "vndf.h").read_text())[1]
setup(version=version, distclass=WithLibrary, cmdclass={"build_py": BuildWithLibrary})
