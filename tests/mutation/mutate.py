#!/usr/bin/python3
"""Tests the tests: applies each mutant of mutants.py to a copy of the sources, builds stages_test there and runs it,
which has to fail. Survivors are listed; exit 1 if one has no explanation, 2 if the sources do not build or pass as they are.

    mutate.py --work DIR [--only TEXT] [--jobs N]

--only takes the mutants whose file, text or replacement contains TEXT. DIR is kept, so that a second run builds faster.
"""
import argparse
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
from mutants import MUTANTS  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = ["CMakeLists.txt", "analysis", "case", "cli", "cmake", "examples", "float_tracer", "oracle", "tests"]
TARGET = "stages_test"


def run(command, **keywords):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **keywords)


class Copy:
    def __init__(self, work, jobs, compiler):
        self.source, self.build, self.jobs = work / "source", work / "build", jobs
        self.source.mkdir(parents=True, exist_ok=True)
        for name in SOURCES:
            sync(ROOT / name, self.source / name)
        configured = run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                          f"-DCMAKE_CXX_COMPILER={compiler}"])
        if configured.returncode != 0:
            trouble("cmake failed", configured.stdout)

    def compiles(self):
        built = run(["ninja", "-C", self.build, f"-j{self.jobs}", TARGET])
        return None if built.returncode == 0 else built.stdout

    def passes(self):
        """None, or what failed first."""
        test = self.build / "tests" / "oracle" / TARGET
        ran = run([test, "--gtest_fail_fast", "--gtest_brief=1"], preexec_fn=limit_processor_time)
        if ran.returncode == 0:
            return None
        failed = [line for line in ran.stdout.splitlines() if line.startswith("[  FAILED  ]")]
        if not failed:
            return f"a crash ({ran.returncode})"
        return failed[0].removeprefix("[  FAILED  ] ").split(",")[0].split(" (")[0]


def limit_processor_time():
    """Against endless loops; not wall time, which a busy machine stretches."""
    resource.setrlimit(resource.RLIMIT_CPU, (100, 100))


def sync(source, target):
    """Copies what differs, and keeps the times of what does not, so that ninja rebuilds only that."""
    if source.is_dir():
        target.mkdir(exist_ok=True)
        for child in source.iterdir():
            if child.name != "__pycache__":
                sync(child, target / child.name)
    elif not target.exists() or target.read_bytes() != source.read_bytes():
        shutil.copyfile(source, target)


def trouble(what, output):
    print(output[-4000:], file=sys.stderr)
    print(f"mutate.py: {what}", file=sys.stderr)
    sys.exit(2)


def mutated(text, mutant):
    old, new = mutant[1], mutant[2]
    if text.count(old) != 1:
        trouble(f"{mutant[0]}: occurs {text.count(old)} times, not once", old)
    return text.replace(old, new)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--compiler", default="clang++-19")
    arguments = parser.parse_args()

    chosen = [m for m in MUTANTS if any(arguments.only in part for part in m[:3])]
    for mutant in MUTANTS:
        mutated((ROOT / mutant[0]).read_text(), mutant)
    copy = Copy(arguments.work, arguments.jobs, arguments.compiler)
    if output := copy.compiles():
        trouble("the sources do not build", output)
    if failed := copy.passes():
        trouble("the tests fail as they are", failed)

    killed, explained, survivors = 0, [], []
    for number, mutant in enumerate(chosen, 1):
        file, old, new = mutant[:3]
        start, path = time.monotonic(), copy.source / file
        original = path.read_text()
        path.write_text(mutated(original, mutant))
        try:
            failure = "does not compile" if copy.compiles() else copy.passes()
        finally:
            path.write_text(original)
        if failure == "does not compile":
            survivors.append((mutant, failure))
        elif failure:
            killed += 1
        elif len(mutant) == 4:
            explained.append(mutant)
        else:
            survivors.append((mutant, "survived"))
        verdict = f"killed by {failure}" if failure else "SURVIVED" + (", as explained" if len(mutant) == 4 else "")
        seconds = time.monotonic() - start
        print(f"{number}/{len(chosen)} {file}: {old!r} -> {new!r}: {verdict} ({seconds:.0f} s)", flush=True)

    print(f"\n{killed} of {len(chosen)} killed, {len(explained)} survive with a reason, {len(survivors)} without")
    for file, old, new, reason in explained:
        print(f"  equivalent: {file}: {old!r} -> {new!r}: {reason}")
    for (file, old, new, *_), what in survivors:
        print(f"  {what}: {file}: {old!r} -> {new!r}")
    sys.exit(1 if survivors else 0)


if __name__ == "__main__":
    main()
