"""The fuzz programs as .clusterfuzzlite/build.sh makes them, in an environment like that of OSS-Fuzz's images: the
same variables, and nothing but archives to link with. The images themselves, and the services, are not run.

Arguments: a folder to work in, which is kept so that a second run builds faster; the fuzz program of the ordinary
build."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ORDINARY = pathlib.Path(sys.argv.pop())
WORK = pathlib.Path(sys.argv.pop())
SOURCE = pathlib.Path(__file__).resolve().parents[2]
LLVM = pathlib.Path("/usr/lib/llvm-19/lib")

CFLAGS = ("-O1 -fno-omit-frame-pointer -gline-tables-only -DFUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION "
          "-fsanitize=fuzzer-no-link ")
UNDEFINED = ("array-bounds,bool,builtin,enum,function,integer-divide-by-zero,null,object-size,return,"
             "returns-nonnull-attribute,shift,signed-integer-overflow,unreachable,vla-bound,vptr")
SANITIZERS = {
    "address": "-fsanitize=address -fsanitize-address-use-after-scope",
    "undefined": f"-fsanitize={UNDEFINED},unsigned-integer-overflow -fno-sanitize-recover={UNDEFINED}",
}
TARGETS = ["baldwin_weber_f32", "baldwin_weber_f64", "brlcad_bot_classic_target", "moller_trumbore_f32",
           "moller_trumbore_f64", "plucker_f32", "plucker_f64", "woop_watertight_f32", "woop_watertight_f64"]
SIZES = {"f32": 68, "f64": 136, "target": 96}
CRASHED = 77


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def libraries_of_an_image(folder):
    """Flags for linking as in an image: libc++ is there as an archive alone, and libFuzzer keeps the standard library
    that it needs to itself. Debian's wants libstdc++, which can't be linked beside libc++: so it is hidden in a copy
    of libFuzzer's archive."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "libc++.a").write_text(f"GROUP({LLVM}/libc++.a {LLVM}/libc++abi.a)\n")
    fuzzer = folder / "fuzzer.o"
    resources = pathlib.Path(output("clang++-19", "-print-resource-dir").strip())
    runtime = pathlib.Path("lib", "linux")
    name = "libclang_rt.fuzzer-x86_64.a"
    output("ld", "-r", "--force-group-allocation", "-o", fuzzer, "--whole-archive", resources / runtime / name,
           "--no-whole-archive", output("g++", "-print-file-name=libstdc++.a").strip())
    output("objcopy", "-w", "--keep-global-symbol=main", "--keep-global-symbol=LLVMFuzzer*",
           "--keep-global-symbol=__sanitizer*", fuzzer)
    copy = folder / "resources"
    (copy / runtime).mkdir(parents=True)
    for path in (resources / runtime).iterdir():
        if path.name != name:
            (copy / runtime / path.name).symlink_to(path)
    output("ar", "rcs", copy / runtime / name, fuzzer)
    return f"-L{folder} -resource-dir={copy}"


def environment(sanitizer):
    folder = WORK / sanitizer
    names = {name: folder / name.lower() for name in ("OUT", "WORK", "SRC")}
    for path in names.values():
        path.mkdir(parents=True, exist_ok=True)
    if not (names["SRC"] / "plumbline").is_symlink():
        (names["SRC"] / "plumbline").symlink_to(SOURCE)
    flags = CFLAGS + SANITIZERS[sanitizer]
    return os.environ | {name: str(path) for name, path in names.items()} | {
        "CC": "clang-19", "CXX": "clang++-19", "CFLAGS": flags, "CXXFLAGS": f"{flags} -stdlib=libc++",
        "LDFLAGS": libraries_of_an_image(folder / "lib"), "LIB_FUZZING_ENGINE": "-fsanitize=fuzzer",
        "CMAKE_GENERATOR": "Ninja"}


def build(sanitizer):
    env = environment(sanitizer)
    out = pathlib.Path(env["OUT"])
    shutil.rmtree(out)
    out.mkdir()
    done = subprocess.run(["bash", "-eux", SOURCE / ".clusterfuzzlite" / "build.sh"], env=env, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{done.stdout[-4000:]}\nbuild.sh failed for {sanitizer}")
    return out


def setUpModule():
    global OUT
    OUT = {sanitizer: build(sanitizer) for sanitizer in SANITIZERS}


class ServiceTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, program, *arguments, code=0):
        env = os.environ | {"UBSAN_OPTIONS": "silence_unsigned_overflow=1"}
        done = subprocess.run([program, *map(str, arguments)], cwd=self.folder, env=env, capture_output=True,
                              text=True, errors="replace", timeout=3600, check=False)
        self.assertEqual(done.returncode, code, done.stderr[-4000:])
        self.assertNotIn("runtime error", done.stderr)
        return done.stderr

    def fuzz(self, target, *arguments, sanitizer="address", code=0):
        return self.run_program(OUT[sanitizer] / f"fuzz_{target}", *arguments, code=code)

    def seeds(self, target):
        folder = self.folder / "seeds"
        with zipfile.ZipFile(OUT["address"] / f"fuzz_{target}_seed_corpus.zip") as archive:
            archive.extractall(folder)
        return folder


class Outputs(ServiceTest):
    def test_what_is_there(self):
        for out in OUT.values():
            expected = {f"fuzz_{target}{end}" for target in TARGETS
                        for end in ("", "_baseline.case", "_seed_corpus.zip", ".options")}
            self.assertEqual({path.name for path in out.iterdir()}, expected)

    def test_programs(self):
        allowed = re.compile(r"\s*(linux-vdso|lib(c|m|dl|rt|pthread|gcc_s|resolv)|/lib64/ld-linux-x86-64)\.so\.\d+ ?")
        for sanitizer, out in OUT.items():
            program = out / f"fuzz_{TARGETS[0]}"
            self.assertRegex(program.name, r"\A[A-Za-z0-9_-]+\Z")
            self.assertIn(b"LLVMFuzzerTestOneInput", program.read_bytes())
            for other in TARGETS[1:]:
                self.assertEqual((out / f"fuzz_{other}").read_bytes(), program.read_bytes())
            libraries = output("ldd", program).splitlines()
            self.assertTrue(libraries)
            for line in libraries:
                self.assertRegex(line, allowed, sanitizer)

    def test_options_and_seeds(self):
        for target in TARGETS:
            size = SIZES[target.rsplit("_", 1)[1]]
            options = (OUT["address"] / f"fuzz_{target}.options").read_text()
            self.assertEqual(options, f"[libfuzzer]\nmax_len = {size}\nlen_control = 0\n")
            with zipfile.ZipFile(OUT["address"] / f"fuzz_{target}_seed_corpus.zip") as archive:
                self.assertGreater(len(archive.infolist()), 20)
                self.assertEqual({entry.file_size for entry in archive.infolist()}, {size})


class Runs(ServiceTest):
    def test_four_runs_from_nothing(self):
        for sanitizer in SANITIZERS:
            for target in TARGETS:
                said = self.fuzz(target, "-seed=1337", "-runs=4", sanitizer=sanitizer)
                self.assertIn("Done 4 runs", said)
                edges = re.search(r"INFO: Loaded 1 modules\s+\((\d+) inline 8-bit counters\)", said)
                self.assertGreater(int(edges[1]), 100)  # with fewer, a service takes a program for uninstrumented

    def test_the_seeds_raise_no_alarm(self):
        for target in TARGETS:
            seeds = self.seeds(target)
            count = len(list(seeds.iterdir()))
            empty = self.folder / "new"  # a service gives its own folder first
            empty.mkdir()
            for folders in ([seeds], [empty, seeds]):
                said = self.fuzz(target, "-runs=0", *folders)
                self.assertRegex(said, rf"INFO: seed corpus: files: {count} ")
            shutil.rmtree(seeds)
            shutil.rmtree(empty)

    def test_what_is_known_raises_no_alarm(self):
        for target in TARGETS:
            self.assertIn("Done 100000 runs", self.fuzz(target, "-seed=1", "-runs=100000"))
        self.assertIn("Done 100000 runs", self.fuzz(TARGETS[0], "-seed=2", "-runs=100000", sanitizer="undefined"))

    def test_every_run_has_another_seed(self):
        program = OUT["address"] / f"fuzz_{TARGETS[0]}"
        said = []
        for i, flags in enumerate(([], [], ["-seed=5"], ["-seed=5"])):
            self.run_program(program, *flags, f"--summary={i}.json", "--runs=1000")
            said.append(json.loads((self.folder / f"{i}.json").read_text()))
        self.assertNotEqual(said[0]["seed"], said[1]["seed"])
        self.assertNotEqual(said[0]["fingerprint"], said[1]["fingerprint"])
        self.assertEqual((said[2]["seed"], said[2]["fingerprint"]), (5, said[3]["fingerprint"]))

    def test_it_finds_what_the_ordinary_build_finds(self):
        for target in TARGETS:
            found = []
            for i, program in enumerate((ORDINARY, *(out / f"fuzz_{target}" for out in OUT.values()))):
                # Apart from the known cases, which would be where the search begins.
                named = self.folder / str(i) / f"fuzz_{target}"
                named.parent.mkdir(exist_ok=True)
                named.symlink_to(program)
                summary = self.folder / "summary.json"
                # Looking for leaks, libFuzzer runs some inputs twice.
                self.run_program(named, "--record", "--seed=7", "--runs=5000", "-detect_leaks=0",
                                 f"--summary={summary}", f"--seeds={SOURCE / 'corpus' / 'hard'}")
                found.append(json.loads(summary.read_text())["fingerprint"])
            self.assertEqual(found, found[:1] * len(found), target)

    def test_merging_keeps_the_elites(self):
        target = "moller_trumbore_f64"
        self.fuzz(target, "--record", "--campaign=campaign", "--seed=3", "--runs=20000")
        elites, merged = self.folder / "campaign" / "elites", self.folder / "merged"
        merged.mkdir()
        self.fuzz(target, "-merge=1", merged, elites)
        self.assertGreater(len(list(merged.iterdir())), 100)
        worst = []
        for folder in (elites, merged):
            self.fuzz(target, "--record", "--summary=summary.json", "--runs=1", folder)
            worst.append(json.loads((self.folder / "summary.json").read_text())["worst_nominal_severity"])
        # A counter's eight ranges stand for eighths of an octave.
        self.assertGreaterEqual(worst[1], worst[0] * 2 ** -0.125)


def functions(said, program):
    """The topmost three functions that are neither the runtime's nor libFuzzer's, named as a service does."""
    frames = re.findall(r"^\s*#\d+ 0x[0-9a-f]+\s.*\((\S+)\+(0x[0-9a-f]+)\)", said, re.M)
    offsets = [offset for path, offset in frames if path.endswith(program.name)]
    names = output("addr2line", "-f", "-C", "-e", program, *offsets).splitlines()[::2]
    names = [name.replace("(anonymous namespace)::", "").split("(")[0] for name in names]
    ignored = re.compile(r"fuzzer::|__sanitizer|__interceptor|main|_start|LLVMFuzzer")
    return [name for name in names if not ignored.match(name)][:3]


class Alarms(ServiceTest):
    """Each class of findings is one bug to a service: its text, its token, its functions."""

    TARGET = "woop_watertight_f32"

    def alarm(self, known, *flags):
        """Token and functions of the alarm of a program that knows these cases, and the input that it left."""
        program = self.folder / f"fuzz_{self.TARGET}"
        if not program.exists():
            shutil.copy(OUT["address"] / program.name, program)
        (self.folder / f"{program.name}_baseline.case").write_text(known)
        said = self.run_program(program, *flags, code=CRASHED)
        told = re.search(r"^plumbline: Assertion `(\w+)' failed\nDEDUP_TOKEN: (\w+)\n", said, re.M)
        self.assertIsNotNone(told, said)
        self.assertEqual(told[1], told[2])
        path = re.search(r"Test unit written to (\S+)", said)
        return told[1], functions(said, program), path and self.folder / path[1]

    @staticmethod
    def token_of(case):
        word = re.search(r"^case (\S+)", case, re.M)[1]
        kind, element = re.match(r"(false-miss|false-hit|displaced|not-finite|death)-"
                                 r"(?:(ab|bc|ca|a|b|c|plane|t_min|t_max)-)?", word).groups()
        conditioning = "nominal" if "-nominal" in word else "ill_conditioned"
        return f"{kind}_{element or 'none'}_{conditioning}".replace("-", "_")

    def test_classes_are_told_apart(self):
        known = (OUT["address"] / f"fuzz_{self.TARGET}_baseline.case").read_text()
        head, *cases = re.split(r"\n(?=\n#)", known)
        tokens = [self.token_of(case) for case in cases]
        self.assertEqual(len(set(tokens)), len(tokens))
        states = {}
        for missing in [i for i, token in enumerate(tokens) if re.fullmatch(r"false_(miss|hit)_(ab|bc)_.*", token)]:
            rest = head + "".join(case for i, case in enumerate(cases) if i != missing)
            token, top, crash = self.alarm(rest, "-seed=1", "-runs=100000")
            self.assertEqual(token, tokens[missing])
            self.assertEqual(len(top), 3)
            self.assertRegex(top[0], r"fail<\d+")
            self.assertEqual(states.setdefault(token, top), top)
            # Again from another seed, and from the input alone: the same bug.
            self.assertEqual(self.alarm(rest, "-seed=2", "-runs=100000")[:2], (token, top))
            self.assertEqual(self.alarm(rest, crash)[:2], (token, top))
        self.assertGreater(len(states), 4)
        self.assertEqual(len({tuple(top) for top in states.values()}), len(states))

    def test_a_merge_goes_on(self):
        seeds, merged = self.seeds(self.TARGET), self.folder / "merged"
        merged.mkdir()
        shutil.copy(OUT["address"] / f"fuzz_{self.TARGET}", self.folder)  # knows nothing
        said = self.run_program(self.folder / f"fuzz_{self.TARGET}", "-merge=1", merged, seeds)
        self.assertIn("MERGE-OUTER: successful in 1 attempt", said)
        self.assertGreater(len(list(merged.iterdir())), 10)


if __name__ == "__main__":
    unittest.main()
