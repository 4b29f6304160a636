"""Fitted coefficients err no more than those that tools/evidence/fits.py finds; a wrong digit is noticed."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["VNDF_SOURCE"])
PROGRAM = pathlib.Path("tools", "evidence", "fits.py")


class Fits(unittest.TestCase):
    def test_the_source(self):
        subprocess.run([sys.executable, SOURCE / PROGRAM], check=True)

    def test_a_wrong_digit_is_noticed(self):
        for name, file, right, wrong in (
            ("arc_rest", "kernel/math.h", "0.142110553f", "0.142111553f"),
            ("law_terms 4", "kernel/law.h", "0.151012047f", "0.151012147f"),
            ("erfc_rest", "kernel/math.h", "0.0355887364f", "0.0355897364f"),
            ("vndf_log", "math/exp_log.h", "0.142857143131269188", "0.142857153131269188"),
        ):
            with self.subTest(name, wrong=wrong), tempfile.TemporaryDirectory() as folder:
                copy = pathlib.Path(folder)
                (copy / PROGRAM).parent.mkdir(parents=True)
                shutil.copy(SOURCE / PROGRAM, copy / PROGRAM)
                shutil.copytree(SOURCE / "src", copy / "src")
                text = (copy / "src" / file).read_text()
                self.assertEqual(text.count(right), 1)
                (copy / "src" / file).write_text(text.replace(right, wrong))
                command = [sys.executable, copy / PROGRAM, name]
                done = subprocess.run(command, capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stderr), (1, ""), done.stdout)


if __name__ == "__main__":
    unittest.main()
