#!/usr/bin/env python3
"""Error of stored light against processor time, beside other programs, in one run (needs numpy).
usage: error_against_time.py [--hemicube BIN] [--peers DIR] [--element-size M] SCENE.glb=REFERENCE.csv ...

Bakes each scene in every preset and scores the light at the vertices (hemicube measure --from-bake) against the table,
whose columns are px,py,pz,nx,ny,nz,E_r,E_g,E_b. Where the folder of peers has peer_cycles.py and this Python has bpy, Cycles
bakes to vertices too; where the folder above it has reference.py and this Python has mitsuba, Mitsuba traces the same points.
  CPU s    user and system time: of hemicube everything from start to end; of Cycles the bake alone; of Mitsuba all
  median, p95   |E - Eref| / max(Eref, 0.02 mean Eref), luminance, per cent        bias   mean(E - Eref) / mean Eref"""
import argparse, csv, importlib.util, json, os, resource, subprocess, sys, tempfile, time
import numpy as np

LUMINANCE = np.array([.2126, .7152, .0722])
PRESETS = ("draft", "medium", "high")


def columns(path, names):
    with open(path, newline="") as f:
        return np.array([[float(row[name] or "nan") for name in names] for row in csv.DictReader(f)])


def table(path):
    return columns(path, ("E_r", "E_g", "E_b")) @ LUMINANCE


def same_points(a, b):
    a, b = (columns(path, ("px", "py", "pz")) for path in (a, b))
    return len(a) == len(b) and np.abs(a - b).max() < 1e-3


def score(reference, found):
    known = np.isfinite(found)
    r, e = reference[known], found[known] - reference[known]
    relative = 100 * np.abs(e) / np.maximum(r, .02 * r.mean())
    return np.median(relative), np.percentile(relative, 95), 100 * e.mean() / r.mean()


def timed(command):
    """Runs to the end: (processor seconds, seconds, what it printed)."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if run.returncode:
        sys.exit("%s\n%s" % (" ".join(command), run.stdout))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    busy = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return busy, time.perf_counter() - start, run.stdout


def line(scene, tool, settings, busy, wall, scores):
    print("%-10s %-9s %-28s %8.2f %8.2f %8.2f %8.2f %+8.2f" % (scene, tool, settings, busy, wall, *scores), flush=True)


def judge(scene, table_path, args, folder):
    name, reference = os.path.splitext(os.path.basename(scene))[0], table(table_path)
    for preset in PRESETS:
        out = os.path.join(folder, "%s-%s.csv" % (name, preset))
        command = [args.hemicube, "measure", scene, "--points", table_path, "-o", out, "--from-bake", "--quality", preset, "--quiet"]
        busy, wall, _ = timed(command)
        line(name, "Hemicube", preset, busy, wall, score(reference, table(out)))
    cycles = os.path.join(args.peers or "", "peer_cycles.py")
    if args.peers and os.path.exists(cycles) and importlib.util.find_spec("bpy"):
        out = os.path.join(folder, name + "-cycles.csv")
        samples = [str(n) for n in args.cycles_samples]
        _, _, told = timed([sys.executable, cycles, scene, table_path, out, "--element-size", str(args.element_size), "--samples", *samples])
        for answer in (json.loads(text) for text in told.splitlines() if text.startswith('{"samples"')):
            settings = "%d vertices, %d samples" % (answer["vertices"], answer["samples"])
            busy = answer["bake_user"] + answer["bake_sys"]
            line(name, "Cycles", settings, busy, answer["bake_s"], score(reference, table(answer["out"])))
    mitsuba = os.path.join(args.peers or "", "..", "reference.py")
    if args.peers and os.path.exists(mitsuba) and importlib.util.find_spec("mitsuba"):
        for target in args.mitsuba_targets:
            command = [sys.executable, mitsuba, scene, "--out", folder, "--name", "mitsuba", "--no-render", "--target", str(target)]
            busy, wall, _ = timed(command)
            found = os.path.join(folder, "mitsuba.csv")
            settings = "only the points, target %.1f %%" % (100 * target)
            # Its choice of points is its own, and the table's if that comes from the same seed.
            scores = score(reference, table(found)) if same_points(table_path, found) else (np.nan,) * 3
            line(name, "Mitsuba", settings, busy, wall, scores)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--hemicube", default=os.path.join(os.path.dirname(__file__), "../../target/release/hemicube"))
    parser.add_argument("--peers")
    parser.add_argument("--element-size", type=float, default=.1)
    parser.add_argument("--cycles-samples", type=int, nargs="+", default=[64, 256])
    parser.add_argument("--mitsuba-targets", type=float, nargs="+", default=[.02])
    args = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:2])
    print("%-10s %-9s %-28s %8s %8s %8s %8s %8s" % ("scene", "program", "settings", "CPU s", "wall s", "median %", "p95 %", "bias %"))
    with tempfile.TemporaryDirectory() as folder:
        for scene in args.scenes:
            path, reference = scene.split("=")
            judge(path, reference, args, folder)


if __name__ == "__main__":
    main()
