"""A table built from Python is the table of `vndf build`; what goes wrong is an exception with the library's words."""
import copy
import inspect
import math
import os
import pickle
import signal
import subprocess
import tempfile
import unittest

import numpy as np
import vndf

SOURCE = os.environ["VNDF_SOURCE"]


class Built(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, "table.vndf")

    def by_program(self, *arguments):
        program = [os.environ["VNDF_PROGRAM"], "build", *arguments, "-o", self.file]
        subprocess.run([*program, "--max-bytes", "2048"], check=True, capture_output=True)
        with open(self.file, "rb") as table:
            return table.read()

    def test_tables_are_those_of_the_program(self):
        csv = os.path.join(SOURCE, "tables", "example.csv")
        for source, options, arguments in (
            (vndf.Source.slope("exp(-a*r)", a=3), {}, ["--slope", "exp(-a*r)", "--set", "a=3"]),
            (vndf.Source.ndf("c^20"), dict(moments=2), ["--ndf", "c^20", "--moments", "2"]),
            (vndf.Source.family("gtr:1.5"), {}, ["--family", "gtr:1.5"]),
            (vndf.Source.csv(csv), dict(max_tv=0.1), ["--csv", csv, "--max-tv", "0.1"]),
        ):
            built = vndf.build(source, max_bytes=2048, **options)
            self.assertEqual(bytes(built), self.by_program(*arguments), arguments)

    def test_rows_are_those_of_a_file(self):
        theta = np.linspace(0, 1.5, 40)
        ndf = np.exp(-5 * theta**2)
        csv = self.file + ".csv"
        np.savetxt(csv, np.stack([theta, ndf], 1), header="theta,ndf", comments="", delimiter=",", fmt="%.17g")
        rows, file = vndf.Source.rows(theta=theta, ndf=ndf), vndf.Source.csv(csv)
        self.assertEqual([rows.p22(r) for r in theta], [file.p22(r) for r in theta])
        slope, p22 = np.tan(theta), ndf * np.cos(theta) ** 4
        self.assertAlmostEqual(vndf.Source.rows(slope=slope, p22=p22).p22(slope[9]), p22[9], 12)

    def test_a_python_function(self):
        asked = []

        def p22(r):
            asked.append(r)
            return math.exp(-r * r)

        table = vndf.build(vndf.Source.slope(p22), max_bytes=4096)
        self.assertGreater(len(asked), 1000)
        self.assertEqual((table.certificate.hidden, table.info.source), (1.0, "--slope-callback p22"))
        wm = np.array([0.0, 0.6, 0.8])
        self.assertAlmostEqual(vndf.Surface(table).ndf(wm) / vndf.Surface(vndf.beckmann()).ndf(wm), 1, 3)


class Refused(unittest.TestCase):
    def test_errors_have_the_words_and_the_kind(self):
        for call, status, words in (
            (lambda: vndf.Source.slope("exp(-"), vndf.Status.SYNTAX, "column 6"),
            (lambda: vndf.Source.slope("exp(-r)", k=2), vndf.Status.ARGUMENT, "has no 'k'"),
            (lambda: vndf.Source.csv("nowhere.csv"), vndf.Status.IO, "nowhere.csv"),
            (lambda: vndf.load(os.path.join(SOURCE, "README.md")), vndf.Status.TABLE, "README.md"),
            (lambda: vndf.build(vndf.Source.slope("1")), vndf.Status.DISTRIBUTION, ""),
            (lambda: vndf.build(vndf.Source.slope("exp(-r)"), max_bytes=5), vndf.Status.ARGUMENT, "max_bytes"),
            (lambda: vndf.Source.rows(theta=[0.0, 1.0], ndf=[1.0, math.nan]), vndf.Status.DISTRIBUTION, "row 1"),
            (lambda: vndf.Material(vndf.Surface(vndf.ggx()), lobes="both"), vndf.Status.ARGUMENT, "FRESNEL"),
        ):
            with self.assertRaisesRegex(vndf.Error, words) as caught:
                call()
            self.assertEqual(caught.exception.status, status)
            self.assertEqual(pickle.loads(pickle.dumps(caught.exception)).status, status)

    def test_wrong_words_and_shapes(self):
        ggx, mirror, slope = vndf.ggx(), vndf.Surface(vndf.ggx()), vndf.Source.slope("exp(-r)")
        up, nan, family = (0.0, 0.0, 1.0), math.nan, vndf.Family.build("student-t", 2, 4, knots=2, max_bytes=2048)
        for error, call in (
            (ValueError, lambda: vndf.Source.rows(theta=[0.0, 1.0], p22=[1.0])),
            (TypeError, lambda: vndf.Source.rows(theta=[0.0, 1.0])),
            (TypeError, lambda: vndf.Source.slope(None)),
            (TypeError, lambda: vndf.Source.slope(3)),
            (ValueError, lambda: vndf.Source.family("gg\0x")),
            (ValueError, lambda: vndf.load("a\0b")),
            (TypeError, lambda: vndf.build("exp(-r)")),
            (ValueError, lambda: vndf.build(slope, max_bytes=-1)),
            (TypeError, lambda: vndf.Surface("ggx", 0.3)),
            (ValueError, lambda: vndf.Surface(ggx, 0.0)),
            (ValueError, lambda: vndf.Surface(ggx, 0.3, nan)),
            (ValueError, lambda: vndf.Surface(ggx, matrix=((1.0, 2.0), (2.0, 4.0)))),
            (ValueError, lambda: vndf.Surface(ggx, matrix=((0.3, 0.0), (0.0, 0.3)), mean=(nan, 0.0))),
            (TypeError, lambda: vndf.Surface(ggx, mean=(0.1, 0.0))),
            (ValueError, lambda: mirror.sample(up, (nan, 0.5))),
            (ValueError, lambda: mirror.sample(up, [[0.1, nan], [0.5, 0.5]])),
            (ValueError, lambda: mirror.sample(None, (0.1, 0.2))),
            (ValueError, lambda: mirror.g1(None)),
            (ValueError, lambda: mirror.g2(up, up, "smith")),
            (ValueError, lambda: vndf.Mixture()),
            (TypeError, lambda: vndf.Mixture([(mirror, 1)])),
            (ValueError, lambda: vndf.Mixture((mirror, -1.0), (mirror, 2.0))),
            (ValueError, lambda: vndf.Mixture((mirror, 0.0))),
            (ValueError, lambda: family.at(nan)),
            (TypeError, lambda: vndf.Material(ggx)),
            (ValueError, lambda: vndf.Material(mirror, fresnel="mirror")),
            (ValueError, lambda: vndf.Material(mirror, fresnel="conductor", eta=(1, 2), k=(1, 2, 3))),
            (ValueError, lambda: vndf.Material(mirror, fresnel="conductor", eta=(1, 2, 3, 4, 5))),
            (ValueError, lambda: vndf.Material(mirror).sample(up, (0.5, 0.5, nan))),
        ):
            with self.assertRaises(error, msg=inspect.getsource(call)):
                call()

    def test_what_owns_memory_is_owned_once(self):
        """A copy of an owner frees nothing twice; a class that is called frees no memory that is not its own."""
        for owner in (vndf.Source.slope("exp(-r)"), vndf.build(vndf.Source.family("gtr:3"), max_bytes=2048)):
            self.assertIs(copy.copy(owner), owner)
            self.assertIs(copy.deepcopy(owner), owner)
            with self.assertRaisesRegex(TypeError, "comes from vndf"):
                type(owner)(12345)
        with self.assertRaisesRegex(TypeError, "vndf.load"):
            vndf.Distribution("rings.vndf")

    def test_pickles(self):
        """What comes out of a file, of bytes or of a pickle answers as what went in; what has no bytes is refused."""
        table = vndf.build(vndf.Source.slope("exp(-r)"), max_bytes=2048)
        built = vndf.Family.build("student-t", 2, 4, knots=3, max_bytes=2048)
        self.assertEqual((*built.parameters[[0, 2]], repr(built).count("3 distributions from 2.0 to 4.0")), (2, 4, 1))
        for stored in (table, built):
            stored.save("file")
            for copied in (type(stored).load("file"), type(stored).from_bytes(bytes(stored))):
                self.assertEqual(bytes(copied), bytes(stored))
        self.assertEqual(pickle.loads(pickle.dumps(vndf.ggx()))._pointer, vndf.ggx()._pointer)
        wm = (0.6, 0.0, 0.8)
        for surface in (vndf.Surface(table, 0.3), built.at(2.5, 0.3), built.at(3.3, [0.3, 0.4])):
            np.testing.assert_array_equal(pickle.loads(pickle.dumps(surface)).ndf(wm), surface.ndf(wm))
        gold = vndf.Material(vndf.Surface(table, 0.3), fresnel="conductor", eta=(0.2, 0.9, 1.1), k=2.0)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(gold)).eval(wm, wm), gold.eval(wm, wm))
        with self.assertRaisesRegex(TypeError, "cannot be pickled"):
            pickle.dumps(vndf.Source.slope("exp(-r)"))

    def test_what_python_raises_comes_through(self):
        def fails(r):
            raise RuntimeError("no value here")

        with self.assertRaisesRegex(RuntimeError, "no value here"):
            vndf.build(vndf.Source.slope(fails))
        with self.assertRaisesRegex(ZeroDivisionError, ""):
            vndf.build(vndf.Source.slope("exp(-r)"), progress=lambda done, what: 1 / 0)

    def test_progress_stops_a_build(self):
        seen = []
        with self.assertRaisesRegex(vndf.Error, "interrupted"):
            vndf.build(vndf.Source.slope("exp(-r)"), progress=lambda *told: seen.append(told) or len(seen) == 3)
        self.assertTrue(len(seen) == 3 and all(0 <= done <= 1 and what for done, what in seen))

    @unittest.skipUnless(hasattr(signal, "setitimer"), "no timers here")
    def test_a_signal_ends_a_build(self):
        def interrupt(*_):
            raise KeyboardInterrupt

        before = signal.signal(signal.SIGALRM, interrupt)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        with self.assertRaises(KeyboardInterrupt):
            vndf.build(vndf.Source.slope("exp(-3*r)*(1+0.8*cos(6*r))"), max_bytes=65536)
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        with self.assertRaises(KeyboardInterrupt):
            vndf.build(vndf.Source.slope(lambda r: math.exp(-r)))


if __name__ == "__main__":
    unittest.main()
