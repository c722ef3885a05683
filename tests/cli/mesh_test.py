"""The verb mesh as others call it: the report as lines and as JSON, meshes that are made, one line and exit code 2
for whatever is no mesh, without the memory that a header promises. Argument: the program."""
import gzip
import hashlib
import json
import os
import pathlib
import resource
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
PLY = ("ply\nformat binary_little_endian 1.0\n"
       "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
       "element face {}\nproperty list uchar int vertex_indices\nend_header\n")
GIGABYTE = 1 << 30


def plumbline(*arguments, limit=None):
    def limit_memory():
        if limit:
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, preexec_fn=limit_memory)


def ply(vertices, faces, promised_vertices=None, promised_faces=None):
    header = PLY.format(promised_vertices or len(vertices), promised_faces or len(faces))
    return (header.encode() + b"".join(struct.pack("<3f", *v) for v in vertices) +
            b"".join(struct.pack("<B3i", 3, *f) for f in faces))


CORNER = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]


class Mesh(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)

    def write(self, name, content):
        path = self.directory / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return str(path)

    def test_report_as_json(self):
        done = plumbline("mesh", self.write("t.obj", OBJ), "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        found = json.loads(done.stdout)
        none = {"count": 0, "triangle": None}
        self.assertAlmostEqual(found.pop("least_edge")["ulps"], 2**23, 3)
        self.assertAlmostEqual(found.pop("least_altitude")["ulps"], 2**22.5, 3)
        self.assertEqual(found, {"triangles": 4, "vertices": 4, "precision": "binary32", "largest_coordinate": 1,
                                 "pieces": 1, "isolated_vertices": 0, "degenerate_triangles": none,
                                 "duplicate_triangles": none, "open_edges": none, "non_manifold_edges": none,
                                 "misoriented_edges": none, "closed": True})

    def test_report_as_lines(self):
        done = plumbline("mesh", self.write("t.obj", OBJ.replace("f 1 4 3", "f 1 4 4")))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for line in ("degenerate triangles    1, the first at triangle 3",
                     "open edges              3, the first at triangle 0", "closed                  no"):
            self.assertIn(line + "\n", done.stdout)

    def test_what_is_made_is_closed_and_the_same_everywhere(self):
        digests = []
        for name, precision in (("a.ply", "binary32"), ("b.ply", "binary64"), ("c.obj", "binary64")):
            path = str(self.directory / name)
            done = plumbline("mesh", "make", "sphere", "--triangles", "2000", "--jitter", "0.01", "--seed", "7",
                             "--precision", precision, "-o", path)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            found = json.loads(plumbline("mesh", path, "--json").stdout)
            self.assertEqual((found["triangles"], found["vertices"], found["precision"], found["closed"]),
                             (2000, 1002, precision, True))
            digests.append(hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()[:16])
        self.assertEqual(digests, DIGESTS)

    def test_bad_meshes_get_one_line(self):
        nan = float("nan")
        facet = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
        bad = {
            "nan.ply": (ply([(0, nan, 0), *CORNER], [(1, 2, 3)]),
                        "vertex 0 (the first is 0) has a coordinate that is not finite"),
            "nan.obj": ("v 0 nan 0\n", ":1: the coordinate 'nan' is not finite"),
            "inf.stl": (bytes(80) + struct.pack("<I", 1) +
                        facet.replace(struct.pack("<f", 1), struct.pack("<f", float("inf"))),
                        "facet 0 has a coordinate that is not finite"),
            "range.ply": (ply(CORNER, [(0, 1, 3)]), "has the index 3, and there are 3 vertices"),
            "negative.ply": (ply(CORNER, [(0, 1, -1)]), "and there are 3 vertices"),
            "range.obj": ("v 0 0 0\nf 1 1 2\n", ":2: vertex 2 of 1"),
            "zero.obj": ("v 0 0 0\nf 1 1 0\n", ":2: vertex 0: OBJ counts from 1"),
            "cut.ply": (ply(CORNER, [(0, 1, 2)])[:-1], "it is cut off, or the header is wrong"),
            "cut.stl": (bytes(80) + struct.pack("<I", 2) + facet, "2 facets take 184 bytes, the file has 134"),
            "cut2.stl": ("solid a\nfacet normal 0 0 1\n", "ends before 'endsolid'"),
            "none.ply": (ply(CORNER, []), "has no triangle"),
            "none.obj": ("v 0 0 0\n", "has no face"),
            "none.stl": (bytes(84), "has no triangle"),
            "many.ply": (ply(CORNER, [(0, 1, 2)], promised_faces=10**7), "promises 10000000 items of 'face'"),
            "more.ply": (ply(CORNER, [(0, 1, 2)], promised_vertices=2**64 - 1), "items of 'vertex'"),
            "many.stl": (bytes(80) + struct.pack("<I", 10**7) + facet,
                         "10000000 facets take 500000084 bytes, the file has 134"),
            "packed.ply": (gzip.compress(ply(CORNER, [(0, 1, 2)])), "is compressed (gzip); unpack it first"),
            "packed.obj.gz": (gzip.compress(OBJ.encode()), "is compressed (gzip); unpack it first"),
            "empty.ply": (b"", "is empty"),
            "empty.stl": (b"", "is empty"),
            "mesh.off": (OBJ, "there are .obj, .ply, .stl"),
            "mesh": (OBJ, "there are .obj, .ply, .stl"),
        }
        for name, (content, message) in bad.items():
            with self.subTest(name):
                self.refused(plumbline("mesh", self.write(name, content), limit=GIGABYTE), message, name)
        os.mkdir(self.directory / "folder.ply")
        self.refused(plumbline("mesh", str(self.directory / "folder.ply")), "is a folder; name a file in it")
        self.refused(plumbline("mesh", str(self.directory / "gone.ply")), "No such file or directory")
        self.refused(plumbline("mesh"), "which mesh? Name a file")

    def test_bad_options_of_make(self):
        path = str(self.directory / "s.ply")
        make = ("mesh", "make", "sphere", "--triangles", "20", "-o", path)
        self.refused(plumbline(*make, "--jitter", "1"), "radii would not be positive")
        self.refused(plumbline(*make, "--jitter", "nan"), "radii would not be positive")
        self.refused(plumbline("mesh", "make", "sphere", "--triangles", "0", "-o", path), "from 1 to 100000000")
        self.refused(plumbline("mesh", "make", "sphere", "--triangles", "100000001", "-o", path), "from 1 to 10000")
        self.refused(plumbline("mesh", "make", "cube", "--triangles", "20", "-o", path), "SHAPE")
        self.refused(plumbline(*make[:-1], path + ".stl"), "is not written")
        self.refused(plumbline(*make[:-1], path + ".x"), "there are .obj, .ply, .stl")
        self.assertEqual(list(self.directory.iterdir()), [])

    def refused(self, done, message, where=""):
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(message, done.stderr)
        self.assertIn(where, done.stderr)

    def test_help_teaches(self):
        done = plumbline("mesh", "--help")
        self.assertEqual(done.returncode, 0)
        self.assertIn("plumbline mesh make sphere --triangles 500000", done.stdout)


DIGESTS = ["f53c7341a283cac9", "08650f65d48865d3", "14d80d6e8954a2f0"]

if __name__ == "__main__":
    unittest.main()
