"""What `cmake --install` gives another project: one that finds it, plugs a tracer in, and has a corpus run against it
by CTest and by GoogleTest; pkg-config; the installed programs. All of it after the installed folder has been moved.
Argument: the build folder. CMAKE, CTEST, CC and CXX name the programs."""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop()).resolve()
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CONSUMER = HERE / "consumer"
CMAKE, CTEST, CC, CXX = (os.environ[name] for name in ("CMAKE", "CTEST", "CC", "CXX"))


def run(*command, **options):
    return subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=600, **options)


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        cls.prefix = cls.folder / "first" / "prefix"
        done = run(CMAKE, "--install", BUILD, "--prefix", cls.prefix)
        assert done.returncode == 0, done.stdout + done.stderr
        # No path of this build or of its prefix is in what others read; and it is moved before anything uses it.
        for file in cls.prefix.rglob("*"):
            if file.suffix in {".cmake", ".pc", ".h"}:
                text = file.read_text()
                assert str(cls.folder) not in text and str(ROOT) not in text, file
        moved = cls.folder / "moved to" / "prefix"
        moved.parent.mkdir()
        cls.prefix = cls.prefix.rename(moved)
        cls.program = cls.prefix / "bin" / "plumbline"

    def fine(self, *command, **options):
        done = run(*command, **options)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout

    def configure(self, source, build, *options):
        return run(CMAKE, "-G", "Ninja", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
                   f"-DCMAKE_C_COMPILER={CC}", f"-DCMAKE_CXX_COMPILER={CXX}", "-Wno-dev", *options)

    def project(self, name, text):
        """A project without a compiler, that says `text`."""
        source = self.folder / name
        source.mkdir()
        (source / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(small LANGUAGES NONE)\n"
            f"enable_testing()\n{text}\n")
        shutil.copytree(CONSUMER / "corpus", source / "corpus")
        return source, self.configure(source, source / "build")

    def ctest(self, build, pattern):
        done = run(CTEST, "--test-dir", build, "-R", pattern, "--output-on-failure", "--no-tests=error")
        outcome = dict(re.findall(r"Test +#\d+: (\S+) \.+ *(?:\*\*\*)?(Passed|Failed)", done.stdout))
        self.assertEqual(done.returncode, 8 if "Failed" in outcome.values() else 0, done.stdout + done.stderr)
        return outcome, done.stdout

    def test_consumer(self):
        build = self.folder / "consumer"
        configured = self.configure(CONSUMER, build)
        self.assertEqual(configured.returncode, 0, configured.stdout + configured.stderr)
        self.fine(CMAKE, "--build", build)
        self.assertEqual(self.ctest(build, "^right")[0],
                         {"right.open": "Passed", "right.plain": "Passed", "right.small": "Passed"})
        outcome, told = self.ctest(build, "^wrong")
        self.assertEqual(outcome, {"wrong.open": "Failed", "wrong.plain": "Passed", "wrong.small": "Failed"})
        # 2^-12, and 2^40 units in the last place of 1.
        margin = "consumer_tracer: new false-miss, severity 0.000244140625 (1.1e+12 ulps)\n"
        gone = "consumer_tracer: known as false-hit, it is now correct; remove the line 'known'\n"
        self.assertIn(f"corpus/small.case: small-triangle: {margin}", told)
        self.assertIn(f"corpus/open.case: hair: {gone}", told)
        outcome, told = self.ctest(build, "^Unit")
        self.assertEqual(outcome, {"Unit.RightOnTheCorpus": "Passed", "Unit.WrongOnTheCorpus": "Failed",
                                   "Unit.NoCorpus": "Failed", "Unit.TruthInProcess": "Passed"})
        corpus = CONSUMER / "corpus"
        self.assertIn(f"{corpus}/small.case:2: small-triangle: {margin}", told)
        self.assertIn("severity   0.000244140625", told)
        self.assertIn(f"{corpus}/open.case:2: hair: {gone}", told)
        self.assertIn(f"{corpus}/none: cannot be opened", told)
        self.assertEqual(told.count("corpus/plain.case"), 0)
        labels = self.fine(CTEST, "--test-dir", build, "-N", "-L", "regression")
        self.assertIn("Total Tests: 6", labels)

    def test_the_examples_of_the_documentation(self):
        blocks = re.findall(r"```(cmake|cpp)\n(.*?)```", (ROOT / "docs" / "regressions.md").read_text(), re.S)
        self.assertEqual([language for language, _ in blocks], ["cmake", "cmake", "cpp"])
        source = self.folder / "documented"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(blocks[0][1])
        shutil.copy(ROOT / "examples" / "c_abi" / "my_tracer.c", source)
        shutil.copytree(CONSUMER / "corpus", source / "corpus", ignore=shutil.ignore_patterns("open.case"))
        done = self.configure(source, source / "build")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.fine(CMAKE, "--build", source / "build")
        self.assertEqual(self.ctest(source / "build", ".")[0],
                         {"my_corpus.plain": "Passed", "my_corpus.small": "Passed"})
        (source / "unit_test.cpp").write_text(blocks[2][1])
        self.fine(CXX, "-std=c++20", "-fsyntax-only", f"-I{self.prefix}/include/plumbline", source / "unit_test.cpp")

    def test_every_header_stands_alone(self):
        headers = sorted((self.prefix / "include" / "plumbline").rglob("*.h"))
        self.assertEqual(len(headers), 23)
        self.fine(CXX, "-std=c++20", "-fsyntax-only", "-w", f"-I{self.prefix}/include/plumbline", "-x", "c++",
                  *headers)

    def test_pkg_config(self):
        environment = os.environ | {"PKG_CONFIG_PATH": str(self.prefix / "lib" / "pkgconfig")}
        told = lambda what: self.fine("pkg-config", what, "plumbline", env=environment).strip()
        self.assertEqual(told("--modversion"), self.fine(self.program, "--version").split()[1])
        self.assertEqual(pathlib.Path(*shlex.split(told("--variable=plumbline"))).resolve(), self.program)
        library = self.folder / "libmine.so"
        self.fine(CC, "-std=c99", "-O2", "-ffp-contract=off", "-shared", "-fPIC", *shlex.split(told("--cflags")),
                  "-o", library, "tracer.c", cwd=CONSUMER)
        self.fine(self.program, "replay", "corpus", "--tracer", library, cwd=CONSUMER)

    def test_fuzz_program_is_found(self):
        found = self.folder / "found"
        self.assertIn("200 executions",
                      self.fine(self.program, "fuzz", "--tracer", "moller_trumbore_f64", "--runs", 200, "-o", found))

    def test_without_a_compiler_or_a_target(self):
        """The component oracle isn't asked for, nor what it needs; a tracer is a program, or of this build."""
        tracer = ROOT / "examples" / "pipe" / "ray_tracer.py"
        source, done = self.project("small", "find_package(plumbline REQUIRED)\n"
                                    f'plumbline_add_corpus(NAME piped TRACER "pipe:/usr/bin/python3 -B {tracer}"\n'
                                    "                     CASES corpus/plain.case TRACER_TIMEOUT 60)\n"
                                    "plumbline_add_corpus(NAME exact TRACER exact\n"
                                    "                     CASES corpus/small.case corpus/open.case)\n"
                                    "if(TARGET plumbline::oracle)\n  message(FATAL_ERROR oracle)\nendif()")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.ctest(source / "build", ".")[0],
                         {"piped.plain": "Passed", "exact.small": "Passed", "exact.open": "Passed"})

    def test_what_cannot_be_registered(self):
        call = "find_package(plumbline REQUIRED)\nplumbline_add_corpus"
        for i, (text, *parts) in enumerate([
                (f"{call}(NAME x TRACER exact CASES nowhere)", "nowhere is not there"),
                (f"file(MAKE_DIRECTORY ${{CMAKE_SOURCE_DIR}}/none)\n{call}(NAME x TRACER exact CASES none)",
                 "holds no .case file"),
                (f"{call}(NAME x TRACER exact)", "CASES is missing"),
                (f"{call}(TRACER exact CASES corpus)", "NAME is missing"),
                (f"{call}(NAME x TRACER exact CASES corpus LABEL y)", "plumbline_add_corpus:"),
                ("find_package(plumbline 99 REQUIRED)", "99"),
                ("find_package(plumbline REQUIRED COMPONENTS oracles)", "no component 'oracles'")]):
            with self.subTest(text=text):
                done = self.project(f"bad{i}", text)[1]
                self.assertNotEqual(done.returncode, 0)
                for part in parts:
                    self.assertIn(part, " ".join(done.stderr.split()))


if __name__ == "__main__":
    unittest.main()
