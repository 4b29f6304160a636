"""The PNG of `vndf render` is what its standard says, by zlib of Python, and holds the numbers of the PFM in sRGB."""
import os
import struct
import subprocess
import unittest
import zlib

import numpy as np

SCENE = """camera --from 0,0,5 --to 0,0,0 --width {} --height {}
environment --image studio
material m --conductor gold --distribution ggx --alpha 0.2
sphere --centre 0,0,0 --radius 1 --material m
"""


def chunks(data):
    at = 8
    while at < len(data):
        (size,) = struct.unpack(">I", data[at : at + 4])
        body, at = data[at + 4 : at + 8 + size], at + 12 + size
        assert zlib.crc32(body) == struct.unpack(">I", data[at - 4 : at])[0]
        yield body[:4], body[4:]


class Images(unittest.TestCase):
    def test_png(self):
        for width, height in ((300, 200), (131, 7), (1, 1)):  # the first in three blocks
            with open("a.scene", "w") as scene:
                scene.write(SCENE.format(width, height))
            for name in ("a.png", "a.pfm"):
                subprocess.run([os.environ["VNDF_PROGRAM"], "render", "a.scene", "--spp", "1", "-q", "-o", name], check=True)
            data, pfm = np.fromfile("a.png", np.uint8).tobytes(), np.fromfile("a.pfm", np.uint8)[-12 * width * height :]
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            (kind, head), *parts, end = chunks(data)
            self.assertEqual((kind, struct.unpack(">IIBBBBB", head)), (b"IHDR", (width, height, 8, 2, 0, 0, 0)))
            self.assertEqual(({kind for kind, _ in parts}, end), ({b"IDAT"}, (b"IEND", b"")))
            rows = np.frombuffer(zlib.decompress(b"".join(part for _, part in parts)), np.uint8).reshape(height, -1)
            self.assertFalse(rows[:, 0].any())  # no filter
            x = pfm.view("<f4").reshape(height, -1)[::-1].astype(float).clip(0, 1)
            wanted = 255 * np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
            self.assertLess(abs(rows[:, 1:] - wanted).max(), 1)


if __name__ == "__main__":
    unittest.main()
