"""Puts the C library into the package, and its kernel in Python, which vndf.mitsuba runs: those that the environment
variables VNDF_LIBRARY and VNDF_KERNEL name, or what CMake builds from the checkout around this folder. pyproject.toml has
everything else."""
from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # setuptools before 70
    from wheel.bdist_wheel import bdist_wheel

HERE = pathlib.Path(__file__).resolve().parent
NAME = {"win32": "vndf.dll", "darwin": "libvndf.dylib"}.get(sys.platform, "libvndf.so")


def build(folder: pathlib.Path) -> tuple[pathlib.Path, pathlib.Path]:
    """Library and kernel, in a folder outside the checkout: what CMake leaves would be sources under tools/."""
    source = HERE.parent.parent
    if not (source / "include" / "vndf.h").exists():
        raise SystemExit(f"{source} is not the checkout of vndf; name a library in VNDF_LIBRARY")
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DVNDF_BUILD_TESTS=OFF"]
    subprocess.run(["cmake", "-S", source, "-B", folder, *options], check=True)
    subprocess.run(
        ["cmake", "--build", folder, "--config", "Release", "--parallel", str(os.cpu_count()),
         "--target", "vndf", "vndf_write_kernel"],
        check=True,
    )  # fmt: skip
    program = next(path for path in folder.rglob("vndf_write_kernel*") if path.is_file() and os.access(path, os.X_OK))
    subprocess.run([program, folder / "_kernel.py"], check=True)
    return next(folder.rglob(NAME)), folder / "_kernel.py"


class BuildWithLibrary(build_py):
    def run(self) -> None:
        super().run()
        package = HERE / "vndf" if self.editable_mode else pathlib.Path(self.build_lib) / "vndf"
        given = os.environ.get("VNDF_LIBRARY"), os.environ.get("VNDF_KERNEL")
        with tempfile.TemporaryDirectory() as folder:
            library, kernel = given if given[0] else build(pathlib.Path(folder))
            shutil.copyfile(library, package / NAME)
            if kernel:
                shutil.copyfile(kernel, package / "_kernel.py")


class PlatformWheel(bdist_wheel):
    """Any Python 3, this platform alone."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


class WithLibrary(Distribution):
    def has_ext_modules(self) -> bool:
        return True


setup(distclass=WithLibrary, cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel})
