#!/usr/bin/python3
"""Records what is known of the tracers that fuzzing services search: for each class of findings (fuzz/alarm.h) the
worst case that some campaigns, each going on from the others, come upon, in fuzz/known/TARGET.case.

    record.py --program FUZZER [--campaigns N] [--runs N] [TARGET...]

FUZZER is build/release/fuzz/plumbline_fuzzer. A TARGET is named like a fuzz program, without fuzz_: TRACER,
TRACER_target. Without any, those that have a file here are recorded anew. The same program gives the same files.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
HARD = HERE.parents[1] / "corpus" / "hard"


def campaign(program, target, seed, runs, folder):
    # The name tells the program what to search.
    named = folder / f"fuzz_{target}"
    if not named.is_symlink():
        named.symlink_to(program)
    subprocess.run([named, "--record", f"--campaign={folder}", f"--seed={seed}", f"--runs={runs}", f"--seeds={HARD}"],
                   cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=True, text=True)


def findings(folder):
    """(class, severity, text) of the worst case of each signature."""
    classes = {}
    for line in (folder / "findings.ndjson").read_text().splitlines():
        found = json.loads(line)
        classes[found["signature"]] = found["kind"], found["element"], found["conditioning"] == "nominal"
    for path in sorted((folder / "findings").glob("*.case")):
        text = path.read_text()
        yield classes[path.stem], float(re.search(r"^# severity (\S+)", text, re.M)[1]), text


def record(program, target, campaigns, runs):
    # One folder: each campaign goes on from what the others came to, as the programs of a service do from what is known.
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(1, campaigns + 1):
            campaign(program, target, seed, runs, pathlib.Path(folder))
        worst = {}
        for name, severity, text in findings(pathlib.Path(folder)):
            if name not in worst or severity > worst[name][0]:
                worst[name] = severity, text
    head = (f"# The worst of each class of findings of {target} that {campaigns} campaigns of {runs} executions,\n"
            "# each going on from the others, came upon: see fuzz/known/README.md.\n")
    return head + "".join("\n" + text.strip() + "\n" for _, (_, text) in sorted(worst.items()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--campaigns", type=int, default=4)
    parser.add_argument("--runs", type=int, default=1_000_000)
    parser.add_argument("targets", nargs="*")
    arguments = parser.parse_args()
    for target in arguments.targets or sorted(path.stem for path in HERE.glob("*.case")):
        text = record(arguments.program.resolve(), target, arguments.campaigns, arguments.runs)
        (HERE / f"{target}.case").write_text(text)
        print(f"{target}: {text.count(chr(10) + 'case ')} classes", flush=True)


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"record.py: {error.stderr}")
