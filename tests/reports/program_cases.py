"""Programs besides the tool: the samples, the counts of GPU instructions, the results of the CPU half. `run` is a Runner."""
import shutil


def room(run):
    """The room of the screen-space sample in OpenGL and Vulkan; the recorded frame."""
    run.program("sample_nnao", "nnao", "sample_nnao", folder="sample_nnao")
    for preset in ("fast", "default", "best"):
        folder = f"sample_vulkan_{preset}"
        run.program(folder, "vulkan", folder, preset, folder=folder)
    run.program("sample_vulkan_mean", "vulkan", "sample_vulkan_mean", "normals", "reversed", "mean",
                folder="sample_vulkan_mean")
    return "sample_nnao/frame.nook"


def crowd(run, glb, model, sky, probe):
    """The crowd with everything that it compares, draws and records, at both tiers."""
    for tier in (33, 43):
        name = f"sample_crowd_{tier}"
        run.program(name, "nook-lab-crowd", glb, model, "--context", "egl", "--tier", tier, "--characters", 4, "--frames", 2,
                    "--size", "160x120", "--out", name, "--quiet", folder=name, report=True)
    name = "sample_crowd_debug"
    run.program(name, "nook-lab-crowd", glb, model, "--context", "egl", "--tier", 33, "--characters", 4, "--frames", 1, "--size",
                "160x120", "--no-sheets", "--light", sky, "--light", probe, "--record", f"{name}/recorded",
                "--measure-world", "--lod-error", 0.1, "--debug", "spheres,key-points,links,levels,error",
                "--debug-bodies", 1, "--out", name, "--quiet", folder=name, report=True)
    name = "sample_crowd_plain"
    run.program(name, "nook-lab-crowd", glb, model, "--context", "egl", "--tier", 43, "--characters", 4, "--frames", 1, "--size",
                "160x120", "--no-sheets", "--no-light", "--screen-space", "off", "--neighbours", 2, "--out", name,
                "--quiet", folder=name, report=True)


def other_samples(run, glb, model, probe, materials):
    run.program("sample_minimal", "minimal", model)
    run.program("sample_ten_lines", "ten_lines", model)
    run.program("sample_viewer", "gltf_viewer", glb, model, "--clip", "Walk", "--frames", 2, "--size", "160x120", "--out",
                "sample_viewer", folder="sample_viewer")
    run.program("sample_material", "material", *materials, "--context", "egl", "--frames", 2, "--size", "160x90",
                "--out", "sample_material", "--quiet", folder="sample_material", report=True)
    run.program("sample_probe", "probe", probe, "sample_probe/picture.png", glb, model, folder="sample_probe")
    run.program("sample_relight", "relight", "sample_relight/picture.png", 16, folder="sample_relight")
    run.program("sample_transfer", "transfer", materials[0], "sample_transfer/picture.png", folder="sample_transfer")
    run.program("sample_web_data", "web_data", glb, model, "sample_web", folder="sample_web")


def shapes(run):
    """Inputs that programs of the tests write."""
    run.program("write_knot", "transfer_shape", "knot", "knot.glb")
    for form in ("none", "binary", "distance"):
        run.program(f"write_open_weave_{form}", "open_weave", f"open_weave_{form}.nook", form)


def library(run, model):
    """Evaluates the library on the CPU, and writes the values that tests compare the page in a browser with. web_picture
    needs the files of the sample web."""
    run.program("write_portability", "write_portability_inputs", "cpu_character.nook", "cpu_material.nook")
    run.program("cpu_results", "cpu_results", "run", "cpu_character.nook", "cpu_material.nook", "cpu.values")
    if run.due("web_picture"):
        shutil.copyfile(run.files / model, run.files / "sample_web/character.nook")
    run.program("web_picture", "web_picture", "sample_web")
    run.program("web_screen", "web_screen", "web_screen", folder="web_screen")


def gpu_counts(run):
    """Instructions of every shader, which the program compiles from its own source tree."""
    run.program("gpu_cost", "nook_gpu_cost", report=True)
