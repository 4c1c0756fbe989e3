"""nook.evaluate_poses against a loop in C over one kept scene: the same bits, and within 1.2 of its time."""
import math
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

import numpy as np

import nook

ROOT = pathlib.Path(__file__).resolve().parents[2]
RINGS, SIDES, POSES = 150, 40, 400
PROGRAM = r"""
#include <nook/nook_character.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static void* file_of(const char* path, size_t* size) {
  FILE* file = fopen(path, "rb");
  fseek(file, 0, SEEK_END);
  *size = (size_t)ftell(file);
  rewind(file);
  void* bytes = malloc(*size);
  if (fread(bytes, 1, *size, file) != *size) exit(2);
  fclose(file);
  return bytes;
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

/* MODEL POSES AO_TO_WRITE: prints the best seconds of all poses in five rounds. */
int main(int argc, char** argv) {
  size_t model_size, pose_size;
  void* bytes = file_of(argv[1], &model_size);
  float* poses = file_of(argv[2], &pose_size);
  nook_context_desc desc;
  nook_context_desc_init(&desc);
  nook_context context;
  nook_model model;
  nook_scene scene;
  nook_instance_id id;
  nook_scene_desc scene_desc;
  nook_scene_desc_init(&scene_desc);
  nook_model_info info = {sizeof info};
  if (argc != 4 || nook_context_create(&desc, &context) || nook_model_load(context, bytes, model_size, &model) ||
      nook_model_describe(model, &info) || nook_scene_create(context, &scene_desc, &scene) ||
      nook_scene_add_instance(scene, model, &id))
    return 1;
  size_t count = pose_size / (48 * info.bone_count);
  float* ao = malloc(count * info.file_vertex_count * sizeof(float));
  double best = 1e9;
  for (int round = 0; round < 5; ++round) {
    double began = seconds();
    for (size_t p = 0; p < count; ++p) {
      nook_pose_desc pose;
      nook_pose_desc_init(&pose);
      pose.kind = NOOK_POSE_REST_TO_WORLD;
      pose.layout = NOOK_TRANSFORM_ROWS_3X4;
      pose.transforms = poses + p * 12 * info.bone_count;
      pose.transform_count = info.bone_count;
      if (nook_scene_set_pose(scene, id, &pose) || nook_scene_update(scene) ||
          nook_scene_read(scene, id, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao + p * info.file_vertex_count,
                          info.file_vertex_count, 0))
        return 1;
    }
    double took = seconds() - began;
    if (took < best) best = took;
  }
  printf("%.9f\n", best);
  FILE* out = fopen(argv[3], "wb");
  fwrite(ao, sizeof(float), count * info.file_vertex_count, out);
  fclose(out);
  return 0;
}
"""


def bent(angle):
    pose = np.tile(np.eye(3, 4, dtype=np.float32), (2, 1, 1))
    c, s = math.cos(angle), math.sin(angle)
    pose[1] = [[c, -s, 0, 0.5 - 0.5 * c], [s, c, 0, -0.5 * s], [0, 0, 1, 0]]
    return pose


def bake():
    """The model of a tube with as many vertices, spheres and key points as a game's character."""
    turn = np.linspace(0, 2 * math.pi, SIDES, endpoint=False)
    positions = np.array([[x, 0.1 * math.cos(t), 0.1 * math.sin(t)] for x in np.linspace(0, 1, RINGS) for t in turn])
    first = (np.arange(RINGS - 1)[:, None] * SIDES + np.arange(SIDES)).ravel()
    second = (np.arange(RINGS - 1)[:, None] * SIDES + (np.arange(SIDES) + 1) % SIDES).ravel()
    triangles = np.concatenate([np.stack([first, second, first + SIDES], 1), np.stack([second, second + SIDES, first + SIDES], 1)])
    weight = np.clip((positions[:, 0] - 0.35) / 0.3, 0, 1)
    frames = np.tile(np.eye(3, 4), (2, 1, 1))
    frames[1, 0, 3] = 0.5
    character = nook.Character.from_arrays(positions, triangles, np.tile([0, 1], (len(positions), 1)), np.stack([1 - weight, weight], 1),
                                           [-1, 0], frames)
    with nook.bake_character(character, preset="draft", poses="extra", extra_poses=[bent(a) for a in np.linspace(-1.6, 1.6, 17)], rays=16,
                             steps=20, spheres=48, key_points=200) as job:
        return job.wait()


class Speed(unittest.TestCase):
    def test_many_poses_take_the_time_of_c(self):
        data = bake()
        model = nook.CharacterModel(data)
        poses = np.stack([bent(angle) for angle in np.linspace(-1.5, 1.5, POSES)])
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "speed.c").write_text(PROGRAM, encoding="utf-8")
            (folder / "model").write_bytes(data)
            (folder / "poses").write_bytes(poses.tobytes())
            library = os.environ["NOOK_LIBRARY"]
            subprocess.run([os.environ.get("CC", "cc"), "-O2", "-I", str(ROOT / "sdk/include"), "speed.c", library,
                            f"-Wl,-rpath,{pathlib.Path(library).parent}", "-o", "speed"], cwd=folder, check=True)
            c, python = [], []
            for _ in range(4):
                run = subprocess.run(["./speed", "model", "poses", "ao"], cwd=folder, check=True, capture_output=True, text=True)
                c.append(float(run.stdout))
                for _ in range(5):
                    # Time of the processor, because other programs may run as well.
                    began = time.process_time()
                    ao = nook.evaluate_poses(model, poses, threads=1)
                    python.append(time.process_time() - began)
            expected = np.fromfile(folder / "ao", np.float32).reshape(ao.shape)
        np.testing.assert_array_equal(ao.view(np.uint32), expected.view(np.uint32))
        ratio = min(python) / min(c)
        print(f"one pose of {model.vertex_count} vertices: C {1e6 * min(c) / POSES:.1f} us, Python {1e6 * min(python) / POSES:.1f} us, "
              f"ratio {ratio:.3f}")
        self.assertLess(ratio, 1.2)


if __name__ == "__main__":
    unittest.main()
