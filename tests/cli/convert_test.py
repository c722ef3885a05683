"""convert: cases as bytes, text and lines of JSON, there and back. Environment: cli_case.py."""
import json
import struct
import unittest

from cli_case import CORPUS, CliTest, question, run


class Convert(CliTest):
    # origin, direction, a, b, c, t_min, t_max
    RAY = (0.25, 0.5, 1, -0.0, 0, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0, float("-inf"), 8)
    TEXT = ("case {}\nprecision {}\n"
            "triangle 0x0p+0 0x0p+0 0x0p+0   0x1p+0 0x0p+0 0x0p+0   0x0p+0 0x1p+0 0x0p+0\n"
            "ray 0x1p-2 0x1p-1 0x1p+0   -0x0p+0 0x0p+0 -0x1p+0\nrange -inf 0x1p+3\n")

    def convert(self, *arguments, text=""):
        result = run("convert", *arguments, text=text)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def write_bytes(self, name, form, *numbers):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(struct.pack(form, *numbers))
        return path

    def test_bytes_to_text_and_back(self):
        for form, precision in [("<17f", "binary32"), ("<17d", "binary64")]:
            with self.subTest(precision=precision):
                ray = self.write_bytes(precision, form, *self.RAY)
                text = self.convert(ray)
                self.assertEqual(text, self.TEXT.format(precision, precision))
                self.convert(self.write("ray.case", text), "--to", "bytes", "-o", self.folder / "made" / "out")
                self.assertEqual((self.folder / "made" / "out" / precision).read_bytes(), ray.read_bytes())

    def test_bytes_to_ndjson_and_back(self):
        ray = self.write_bytes("a", "<17d", *self.RAY)
        lines = self.convert(ray, "--to", "ndjson")
        self.assertEqual(json.loads(lines)["origin"], [0.25, 0.5, 1])
        for path in (self.write("a.ndjson", lines), self.write("a.jsonl", lines), "-"):
            self.convert(path, "--to", "bytes", "-o", self.folder / "out", text=lines)
            self.assertEqual((self.folder / "out" / "a").read_bytes(), ray.read_bytes())
        self.assertEqual(self.convert("-", text=lines), self.TEXT.format("a", "binary64"))

    def test_the_reports_rays_in_the_target_space(self):
        rays = run("generate", "lattice", "--count", "640").stdout
        self.convert("-", "--to", "bytes", "--space", "target", "-o", self.folder / "rays", text=rays)
        files = sorted((self.folder / "rays").iterdir())
        self.assertEqual([path.stat().st_size for path in files], [96] * 640)
        back = self.convert(self.folder / "rays", "--to", "ndjson")
        self.assertEqual(sorted(back.splitlines()), sorted(rays.splitlines()))
        # a, b, c, tolerance, standoff, target
        self.assertEqual(struct.unpack("<11dQ", (self.folder / "rays" / "lattice-10-10").read_bytes()),
                         (0, 0, 0, 0, 0, 1.5, 0, 1.5, 0, 0.1, 5, 10))

    def test_a_folder_of_all_forms(self):
        self.write_bytes("in/a", "<17f", *self.RAY)
        self.write("in/b.case", self.TEXT.format("b", "binary32") + "\n" + self.TEXT.format("c", "binary64"))
        self.write("in/d.ndjson", question('"d"', "[0,0,1]"))
        text = self.convert(self.folder / "in")
        self.assertEqual([line for line in text.splitlines() if line.startswith("case")],
                         ["case a", "case b", "case c", "case d"])
        self.convert(self.folder / "in", "--to", "bytes", "-o", self.folder / "out")
        self.assertEqual({path.name: path.stat().st_size for path in (self.folder / "out").iterdir()},
                         {"a": 68, "b": 68, "c": 136, "d": 136})

    def test_domains(self):
        huge = self.write_bytes("huge", "<17d", 2.0**20, *self.RAY[1:])
        self.assertIn("ray 0x1p-40 ", self.convert(huge))
        text = self.convert(huge, "--domain", "full")
        self.assertIn("ray 0x1p+20 ", text)
        path = self.write("huge.case", text)
        self.assert_trouble(run("convert", path, "--to", "bytes", "-o", self.folder / "out"),
                            "huge.case: case 'huge'", "beyond the nominal domain; add --domain full")
        self.convert(path, "--to", "bytes", "--domain", "full", "-o", self.folder / "out")
        self.assertEqual((self.folder / "out" / "huge").read_bytes(), huge.read_bytes())

    def test_the_corpus_survives(self):
        for path in sorted((CORPUS / "hard").glob("*.case")):
            out = self.folder / path.stem
            self.convert(path, "--to", "bytes", "--domain", "full", "-o", out)
            back = self.convert(out, "--domain", "full", "--to", "ndjson")
            straight = [json.loads(line) for line in self.convert(path, "--to", "ndjson").splitlines()]
            aimless = [{k: v for k, v in case.items() if k not in ("target", "tolerance", "standoff", "wish")}
                       for case in straight]
            self.assertEqual([json.loads(line) for line in back.splitlines()], sorted(aimless, key=lambda c: c["id"]))

    def test_trouble(self):
        odd = self.write_bytes("odd", "<16d", *self.RAY[:16])
        flat = self.write_bytes("flat", "<12d", *[0] * 12)
        good = self.write("good.case", self.TEXT.format("x", "binary64"))
        two = self.write("two.case", good.read_text().replace("ray", "triangle 0 0 0 1 0 0 0 1 0\nray"))
        tenth = self.write("tenth.case", good.read_text().replace("0x1p-2", "0.1"))
        (self.folder / "empty").mkdir()
        self.write_bytes("same/x", "<17d", *self.RAY)
        (self.folder / "same" / "y.case").write_text(good.read_text())
        to_bytes = ("--to", "bytes", "-o", self.folder / "out")
        for arguments, *parts in [
            ((odd,), "odd: 128 bytes", "68 (ray space, binary32), 136 (ray space, binary64), 48 (target", ".case"),
            ((odd, "--space", "target", "--precision", "binary32"), "has 48 (target space, binary32); name"),
            ((flat,), "flat: case 'flat'", "a NaN (ray origin, x)", "or use --to ndjson"),
            ((good, "--to", "bytes"), "add -o with a folder"),
            ((good, *to_bytes, "--space", "target"), "good.case: case 'x' is no input of the target space in",
             "the aim that leads to the ray", "try another --space"),
            ((two, *to_bytes), "two.case: case 'x' is no input of the ray space", "one triangle"),
            ((tenth, *to_bytes, "--precision", "binary32"), "tenth.case: case 'x'", "binary32", "--precision"),
            ((self.folder / "empty",), "empty: no file in this folder"),
            ((self.folder / "same",), "y.case: a second case 'x'; rename"),
            ((self.folder / "same", *to_bytes), "y.case: a second case 'x'; rename"),
            ((self.folder / "absent",), "absent: cannot be opened"),
            ((good, "--to", "xml"), "--to", "xml"),
        ]:
            with self.subTest(arguments=arguments):
                self.assert_trouble(run("convert", *arguments), *parts)
        for identity in ("../x", "", ".", "x.case"):
            with self.subTest(identity=identity):
                self.assert_trouble(run("convert", "-", *to_bytes, text=question(json.dumps(identity), "[0,0,1]")),
                                    f"case '{identity}': no name for a file of bytes; rename")
        self.assertEqual([path.name for path in (self.folder / "out").iterdir()], ["x"])


if __name__ == "__main__":
    unittest.main()
