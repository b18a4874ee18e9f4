#!/usr/bin/env python3
"""Faults put into runs of the program: a system call fails, an allocation fails, a signal comes.

Called by scripts/faults.sh, which builds what is needed. Every run is done again without a fault, in the same folder.
What must hold stands in judge() and again(). Exit code 1 if something did not.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

# Errors that these calls are documented to give. Where a call fails in the loader or in the C library alone
# (futex, mprotect, signal masks) the program has no say: those are left out; so is brk, whose failure looks otherwise
# than strace can say it (the allocations cover it).
ERRORS = {
    "openat": "EACCES", "read": "EIO", "pread64": "EIO", "write": "ENOSPC", "writev": "ENOSPC", "close": "EIO",
    "rename": "EIO", "renameat2": "EIO", "unlink": "EACCES", "unlinkat": "EACCES", "rmdir": "EACCES",
    "mkdir": "ENOSPC", "newfstatat": "EIO", "fstat": "EIO", "lstat": "EIO", "stat": "EIO", "statx": "EIO",
    "getdents64": "EIO", "readlink": "EACCES", "readlinkat": "EACCES", "flock": "EIO", "fcntl": "EIO",
    "fsync": "EIO", "ftruncate": "EIO", "lseek": "EIO", "mmap": "ENOMEM", "clone3": "EAGAIN",
    "getcwd": "ENOENT", "access": "EACCES", "faccessat2": "EACCES", "uname": "EFAULT", "sysinfo": "EFAULT",
    "sched_getaffinity": "EINVAL", "poll": "EINTR", "ioctl": "EINVAL", "prlimit64": "EINVAL",
    "clock_nanosleep": "EINTR", "pipe2": "EMFILE",
}
SIGNALS = ["SIGINT", "SIGTERM", "SIGKILL"]
DOCUMENTED = {0, 2, 3, 4, 5, 6, 7, 130, 143}  # docs/results.md; 70, an internal error, is a finding
LONGEST = 60  # seconds for one run of something that takes a tenth


def sha256(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def files_in(folder):
    found = {}
    for parent, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(parent, name)
            found[os.path.relpath(path, folder)] = sha256(path)
    return found


def manifest_of(folder):
    try:
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return None


class Case:
    """A case file and what comes of it when nothing fails."""

    def __init__(self, program, path, work):
        self.program, self.path = program, os.path.abspath(path)
        self.name = os.path.splitext(os.path.basename(path))[0]
        folder = tempfile.mkdtemp(dir=work)
        self.code = self.run(folder, [], {})[0]
        self.files = files_in(os.path.join(folder, "out"))
        shutil.rmtree(folder)

    def command(self):
        return [self.program, "run", self.path, "--out", "out", "--no-plots"]

    def run(self, folder, prefix, variables):
        done = subprocess.run(prefix + self.command(), cwd=folder, env={**os.environ, **variables},
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              timeout=LONGEST, check=False)
        code = done.returncode if done.returncode >= 0 else 128 - done.returncode
        return code, done.stderr.decode(errors="replace")

    def steady(self, files):
        """Without what differs from run to run, and without what says so of it."""
        return {name: digest for name, digest in files.items() if name not in ("timings.json", "manifest.json")}


def judge(case, out, code, killed):
    """What does not hold of a run with a fault, in words."""
    wrong = []
    if code not in DOCUMENTED and not (killed and code == 137):
        wrong.append(f"exit code {code}")
    try:
        manifest = manifest_of(out)
    except ValueError:
        return wrong + ["manifest.json is damaged"]
    state = manifest["state"] if manifest else None
    if code in (0, 4, 5) and code != case.code:
        wrong.append(f"exit code {code} instead of {case.code}")
    if code in (0, 4, 5) and state != "whole":
        wrong.append(f"exit code {code} and a manifest that says {state}")
    if state in ("whole", "interrupted"):
        for entry in manifest["files"]:
            path = os.path.join(out, entry["path"])
            if not os.path.exists(path):
                wrong.append(f"{entry['path']} is listed and not there")
            elif "sha256" in entry and entry["sha256"] != sha256(path):
                wrong.append(f"the hash of {entry['path']} does not fit")
    if state == "whole" and case.steady(files_in(out)).items() < case.steady(case.files).items():
        wrong.append("the manifest says whole, and files are not there")
    if state == "whole":
        found = files_in(out)
        wrong += [f"{name} differs from that of a run without a fault"
                  for name, digest in case.steady(case.files).items() if found.get(name, digest) != digest]
    return wrong


def again(case, folder):
    """What does not hold of the next run, in the same folder and without a fault."""
    code, said = case.run(folder, [], {})
    wrong = [] if code == case.code else [f"the next run ends with {code}: {said.strip()[-200:]}"]
    found = files_in(os.path.join(folder, "out"))
    wrong += [f"the next run leaves {name}" for name in found if name not in case.files]
    wrong += [f"the next run writes another {name}" for name, digest in case.steady(case.files).items()
              if found.get(name) != digest]
    return wrong


def tried(case, work, name, prefix, variables, killed=False, hit=None):
    """One run with a fault and one without. @returns (name, was there a fault?, what is wrong)"""
    folder = tempfile.mkdtemp(dir=work)
    try:
        log = os.path.join(folder, "strace")
        prefix = [word.replace("@LOG", log) for word in prefix]
        try:
            code, said = case.run(folder, prefix, variables)
        except subprocess.TimeoutExpired:
            return name, True, ["no end"]
        happened = True
        if hit and os.path.exists(log):
            with open(log, encoding="utf-8", errors="replace") as file:
                happened = hit in file.read()
        out = os.path.join(folder, "out")
        wrong = judge(case, out, code, killed) + again(case, folder)
        if wrong:
            wrong.append("it said: " + said.strip()[-300:])
        return name, happened, wrong
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def calls_of(case, work):
    """System calls of the first thread behind the loader: {name: (number before, number in all)}."""
    folder = tempfile.mkdtemp(dir=work)
    log = os.path.join(folder, "strace")
    case.run(folder, ["strace", "-f", "-qq", "-o", log], {})
    counts, first, began = {}, None, False
    with open(log, encoding="utf-8", errors="replace") as file:
        for line in file:
            match = re.match(r"(\d+)\s+(\w+)\(", line)
            if not match:
                continue
            first = first or match[1]
            if match[1] != first:
                continue
            began = began or "rt_sigaction(SIGINT" in line  # the first thing that the program does
            before, total = counts.get(match[2], (0, 0))
            counts[match[2]] = (before + (not began), total + 1)
    shutil.rmtree(folder)
    return counts


def chosen(numbers, most, seed):
    """All of them, or as many as wanted: the first ones, and others by chance."""
    numbers = list(numbers)
    if len(numbers) <= most:
        return numbers
    return sorted(numbers[: most // 3] + random.Random(seed).sample(numbers[most // 3:], most - most // 3))


def of_calls(case, work, arguments):
    def fault(call, k, what, words, killed, path=()):
        prefix = ["strace", "-f", "-qq", "-o", "@LOG", *path, "-e", f"trace={call}", "-e", f"inject={call}:{what}:when={k}"]
        hit = "(INJECTED)" if what.startswith("error") else "killed by" if killed else "--- "
        where = " of the case file" if path else ""
        return (case, work, f"{case.name}: {call} number {k}{where}: {words}", prefix, {}, killed, hit)

    counts = calls_of(case, work)
    for call, (before, total) in sorted(counts.items()):
        numbers = chosen(range(before + 1, total + 1), arguments.most, arguments.seed)
        for k in numbers:
            if call in ERRORS and "calls" in arguments.kinds:
                yield fault(call, k, "error=" + ERRORS[call], ERRORS[call], False)
            if "signals" in arguments.kinds:
                for name in SIGNALS:
                    yield fault(call, k, "signal=" + name, name, name == "SIGKILL")
    # The case is read by a thread of its own, whose calls are told by their file.
    if "calls" in arguments.kinds:
        for call in ("openat", "read", "newfstatat", "fstat", "close", "lseek", "poll"):
            for k in range(1, 5):
                yield fault(call, k, "error=" + ERRORS[call], ERRORS[call], False, ("-P", case.path))


def of_allocations(case, work, arguments):
    folder = tempfile.mkdtemp(dir=work)
    counted = os.path.join(folder, "count")
    case.run(folder, [], {"LD_PRELOAD": arguments.shim, "COUNT_ALLOCATIONS": counted})
    with open(counted, encoding="utf-8") as file:
        total = int(file.read())
    shutil.rmtree(folder)
    print(f"{case.name}: {total} allocations", flush=True)
    for k in chosen(range(1, total + 1), arguments.allocations, arguments.seed):
        for which in (str(k), f"{k}+"):
            words = f"{case.name}: allocation {k} fails" + (" and all behind it" if which.endswith("+") else "")
            yield case, work, words, [], {"LD_PRELOAD": arguments.shim, "FAIL_ALLOCATION": which}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--shim", required=True, help="failing_allocation.so")
    parser.add_argument("--work", required=True, help="folder for runs and findings")
    parser.add_argument("--kinds", nargs="+", default=["calls", "signals", "allocations"])
    parser.add_argument("--most", type=int, default=1000000, help="numbers k of each system call")
    parser.add_argument("--allocations", type=int, default=2000, help="numbers k of allocations")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("cases", nargs="+")
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    began = time.monotonic()
    findings = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool, \
            open(os.path.join(arguments.work, "findings.txt"), "w", encoding="utf-8") as kept:
        for path in arguments.cases:
            case = Case(arguments.program, path, arguments.work)
            wanted = [] if arguments.kinds == ["allocations"] else list(of_calls(case, arguments.work, arguments))
            if "allocations" in arguments.kinds:
                wanted += of_allocations(case, arguments.work, arguments)
            runs = faults = wrong_runs = 0
            for name, happened, wrong in pool.map(lambda one: tried(*one), wanted):
                runs += 1
                faults += happened
                wrong_runs += bool(wrong)
                if wrong:
                    kept.write(name + "\n" + "".join(f"    {line}\n" for line in wrong))
                    kept.flush()
            findings += wrong_runs
            print(f"{case.name}: {runs} runs, {faults} with their fault, {wrong_runs} findings", flush=True)
    print(f"{time.monotonic() - began:.0f} s" + (f"; see {arguments.work}/findings.txt" if findings else "; nothing found"))
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
