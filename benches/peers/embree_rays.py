"""Embree on the rays of benches/rays.rs (needs numpy and embreex).
usage: embree_rays.py RAYS.bin PROCESSES RUNS
RAYS.bin: number of triangles and of rays (uint32), corners [triangle, 3, 3], origin and direction [ray, 2, 3] (float32).
Prints for each kind of query: rays a second on the wall, rays a processor second, share of the rays that hit."""
import multiprocessing as mp, resource, sys, time
import numpy as np


def read(path):
    with open(path, "rb") as f:
        triangles, rays = np.fromfile(f, np.uint32, 2)
        corners = np.fromfile(f, np.float32, 9 * triangles).reshape(-1, 3, 3)
        lines = np.fromfile(f, np.float32, 6 * rays).reshape(-1, 2, 3)
    return corners, lines


def work(path, part, parts, runs, bar, answers):
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh
    corners, lines = read(path)
    lines = lines[part * len(lines) // parts:(part + 1) * len(lines) // parts]
    origin, direction = np.ascontiguousarray(lines[:, 0]), np.ascontiguousarray(lines[:, 1])
    scene = rtcore_scene.EmbreeScene()
    TriangleMesh(scene, corners)
    scene.run(origin[:1], direction[:1])      # builds the tree
    found = []
    for query in ("INTERSECT", "OCCLUDED"):
        for _ in range(runs):
            bar.wait()
            busy, start = resource.getrusage(resource.RUSAGE_SELF).ru_utime, time.perf_counter()
            hits = scene.run(origin, direction, query=query)
            found.append((time.perf_counter() - start, resource.getrusage(resource.RUSAGE_SELF).ru_utime - busy,
                          int((np.asarray(hits) >= 0).sum()), len(lines)))
    answers.put(found)


def main(path, processes, runs):
    bar, answers = mp.Barrier(processes), mp.Queue()
    workers = [mp.Process(target=work, args=(path, i, processes, runs, bar, answers)) for i in range(processes)]
    for worker in workers: worker.start()
    found = np.array([answers.get() for _ in workers])      # [process, query and run, value]
    for worker in workers: worker.join()
    for query in range(2):
        of = found[:, query * runs:(query + 1) * runs]
        rays = of[:, 0, 3].sum()
        wall, busy = np.median(of[:, :, 0].max(0)), np.median(of[:, :, 1].sum(0))
        print(rays / wall, rays / max(busy, 1e-9), of[:, 0, 2].sum() / rays)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
