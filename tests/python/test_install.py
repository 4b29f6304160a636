"""pip installs the package from the checkout, with the library inside; it works where the checkout is not."""
import os
import shutil
import subprocess
import sys
import unittest

if subprocess.run([sys.executable, "-c", "import setuptools, pip, wheel"], capture_output=True).returncode:
    print("SKIPPED: Python has no pip, setuptools or wheel")
    sys.exit(0)


class Installed(unittest.TestCase):
    def test_pip(self):
        package = os.path.join(os.environ["VNDF_SOURCE"], "tools", "python")
        shutil.copytree(package, "package")  # pip writes into what it builds from
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation"]
        subprocess.run([*pip, "--target", "installed", "./package"], check=True)
        bare = {name: value for name, value in os.environ.items() if not name.startswith("VNDF")}
        code = "import vndf; print(vndf.__file__, vndf.Surface(vndf.ggx(), 0.5).g1((0, 0.6, 0.8)))"
        bare["PYTHONPATH"] = os.path.abspath("installed")
        said = subprocess.run([sys.executable, "-c", code], env=bare, check=True, stdout=subprocess.PIPE, cwd="/")
        self.assertIn(b"installed", said.stdout)


if __name__ == "__main__":
    unittest.main()
