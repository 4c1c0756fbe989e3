"""The commands of nook and nook-lab at small settings, by system. `run` is a Runner."""


def character_forms(run, glb):
    """Bakes by every kernel and fit."""
    small = ["--preset", "draft", "--rays", 8, "--auto-poses", 6, "--samples-per-clip", 2, "--steps", 2, "--spheres",
             8, "--key-points", 16]
    run.bake("mannequin_paper", "bake character", glb, *small, "--kernel", "paper", "--fit", "paper")
    run.bake("mannequin_learned", "bake character", glb, *small, "--gamma", "learned",
             "--poses", "auto")
    run.bake("mannequin_norm", "bake character", glb, *small, "--gamma", 2, "--saturation", 0, "--split", "families",
             "--poses", "clips")
    run.bake("mannequin_walk", "bake character", glb, *small, "--clips", "Walk", "--saturation", 1)


def character(run, name, glb, *bake_options):
    model = run.bake(name, "bake character", glb, "--preset", "draft", "--rays", 16, "--auto-poses", 24,
                     "--samples-per-clip", 3, "--steps", 60, "--split", "half", *bake_options)
    run.report(f"evaluate_{name}_clips", "evaluate", "character", glb, model, "--rays", 16, "--samples-per-clip", 4)
    run.report(f"evaluate_{name}_casters", "evaluate", "casters", glb, model, "--rays", 16, "--bearings", 2,
               "--poses", 2)
    run.report(f"evaluate_{name}_world", "evaluate", "world", glb, model, "--rays", 32, "--points", 60, "--max-poses", 4)
    return model


def mannequin(run, glb, sky):
    model = character(run, "mannequin", glb)
    evaluate = ["evaluate", "character", glb, model, "--rays", 16]
    run.report("evaluate_mannequin_training", *evaluate, "--poses", "training", "--max-poses", 8)
    run.report("evaluate_mannequin_baselines", *evaluate, "--samples-per-clip", 3, tool="nook-lab")
    run.report("evaluate_mannequin_pictures", *evaluate, "--clips", "Walk", "--max-poses", 2, "--images",
               "mannequin_error", "--image-count", 1)
    casters = ["evaluate", "casters", glb, model, "--rays", 16]
    run.report("evaluate_mannequin_casters_radii", *casters, "--radii", "--distances", "0.5,2", "--bearings", 1,
               "--poses", 1, "--images", "mannequin_pairs")
    run.report("evaluate_mannequin_contact", *casters, "--contact", "Walk", "Idle", 0.4, 0, 0.1, 90, "--images",
               "mannequin_contact")
    character_forms(run, glb)
    return model


def darkened_world(run, glb, model, sky):
    """Measures how a character darkens its surroundings, and exports its casters."""
    world = ["evaluate", "world", glb, model]
    run.report("evaluate_world_pictures", *world, "--rays", 16, "--points", 40, "--max-poses", 1, "--clips", "Walk",
               "--images", "world_pictures", "--image-count", 1)
    run.report("evaluate_world_composite", *world, "--composite", "--views", 1, "--figures", 2, "--rays", 8,
               "--images", "world_composite")
    run.report("evaluate_world_light", *world, "--light", sky, "--points", 40, "--max-poses", 2, "--rays", 16,
               "--figures", 2, "--images", "world_light")
    for form in ("unreal", "source2", "gltf"):
        run.report(f"export_{form}", "export", "casters", model, "--format", form, "-o", f"casters_{form}.txt")
    run.report("export_light", "export", "casters", model, "--format", "source2", "--radii", "light", "-o",
               "casters_light.txt")


def bent_normals(run, glb, model, sky):
    bent = run.bake("mannequin_bent", "bake bent", glb, model, "--auto-poses", 8, "--samples-per-clip", 1, "--rays", 16)
    run.report("evaluate_bent", "evaluate", "bent", glb, bent, "--maps", sky, "--max-poses", 2, "--points", 60,
               "--rays", 64, "--images", "bent", "--image-count", 1)
    run.report("train_bent", "train", "bent", glb, bent, "-o", "scene_specular_numbers.h", "--max-poses", 2,
               "--points", 80, "--steps", 500)


def baked_clips(run, glb, model):
    clips = run.bake("mannequin_clips", "bake clips", glb, model, "--clips", "Walk", "--frames-per-second", 6,
                     "--rays", 8, "--max-modes", 8, "--max-bytes", 4)
    run.report("evaluate_clips", "evaluate", "clips", glb, model, clips, "--rays", 8, "--max-poses", 4, "--pairs", 1,
               "--distances", "0.8")


def levels(run, glb, model):
    run.bake("mannequin_lod", "bake lod", model, glb, "--auto-poses", 8, "--samples-per-clip", 1, "--rays", 8)
    run.report("evaluate_lods", "evaluate", "lods", glb, model, "--shares", 0.2, "--samples-per-clip", 1,
               "--max-poses", 2, "--training-poses", 8, "--rays", 8)


def maps(run, name, sky):
    small = ["--samples", 20000]
    forms = {"default": [],
             "moments": ["--method", "moments", "--sharpness", 6],
             "least_squares": ["--method", "least-squares", "--ambient", "--packing", "half"],
             "average": ["--method", "running-average", *small, "--sharpness", 4],
             "average_original": ["--method", "running-average-original", *small, "--sampling", "uniform"],
             "average_non_negative": ["--method", "running-average-non-negative", *small],
             "naive": ["--method", "naive", *small, "--sampling", "luminance", "--lobes", 6],
             "non_negative": ["--method", "non-negative-least-squares", "--hemisphere", "--packing", "rgb9e5"],
             "no_bands": ["--constraint", "none", "--lobes", 24, "--picture", f"{name}_no_bands.png"],
             "harmonics": ["--basis", "harmonics", "--order", 3, "--method", "least-squares"],
             "dice": ["--basis", "dice", "--method", "least-squares"]}
    models = [run.bake(f"{name}_{form}", "bake probe", sky, *options) for form, options in forms.items()]
    run.report(f"evaluate_{name}", "evaluate", "probe", sky, *models, "--seeds", 2, "--images", f"{name}_lobes",
               tool="nook-lab")
    run.report(f"evaluate_{name}_lobes_5", "evaluate", "probe", sky, "--seeds", 1, "--lobes", 5, "--rotations", 2,
               tool="nook-lab")
    run.report(f"evaluate_{name}_glossy", "evaluate", "probe", sky, models[0], "--glossy", "--surfaces", 8,
               tool="nook-lab")


def grid(run, name, scene, sky, *options):
    bake = ["--light", sky, "--grid", "3x2x2"]
    evaluate = ["evaluate", "probe", "--scene", scene, "--light", sky, "--points", 128, "--paths", 128, *options]
    model = run.bake(f"{name}_grid", "bake probe", scene, *bake, "--samples", 1024, *options)
    run.report(f"evaluate_{name}_grid", *evaluate, model)
    forms = {"walls": ["--walls", "--basis", "harmonics", "--order", 2, "--training-paths", 16],
             "sky": ["--direct", "sky", "--basis", "dice", "--error", 0.2],
             "none": ["--direct", "none", "--box", "-1,0.2,-1,1,1.8,1", "--no-textures"]}
    for form, more in forms.items():
        model = run.bake(f"{name}_grid_{form}", "bake probe", scene, *bake, "--samples", 512, *more, *options)
        run.report(f"evaluate_{name}_grid_{form}", *evaluate, model)


def look_ups(run, scene, sky):
    small = ["--points", 32, "--paths", 16, "--samples", 256, "--training-paths", 8]
    run.report("evaluate_grid_rooms", "evaluate", "grid", *small, "--grid", "4x2x3", "--picture", "rooms.png")
    run.report("evaluate_grid_scene", "evaluate", "grid", *small, "--scene", scene, "--light", sky, "--grid", "2x2x2")


def material(run, name):
    raw, unseen = f"{name}.raw", f"{name}_unseen.raw"
    trace = ["--meso", name, "--texels", 16, "--samples", 1, "--bounce-rays", 16]
    ranks = ["--ranks", "6,16,8,8", "--votf-ranks", "8,8"]
    model = run.bake(name, "bake material", *trace, *ranks, "--directions", 24, "--keep-raw", raw, "--images",
                     f"{name}_pictures")
    run.bake(f"{name}_unseen", "bake material", *trace, *ranks, "--directions", 20, "--lights", 24, "--keep-raw",
             unseen)
    run.report(f"inspect_{name}_raw", "inspect", raw)
    forms = {"auto": ["--ranks", "auto", "--threshold", 0.05, "--votf", "binary"],
             "cta": [*ranks, "--method", "cta", "--view-map", 0],
             "n_svd": [*ranks, "--method", "n-svd", "--votf", "none"],
             "mixture": [*ranks, "--mixture", 2, "--cluster-rank", 8, "--seeding", "values", "--view-map", 16,
                         "--step-penalty", 10],
             "halves": [*ranks, "--bits", 16, "--visibility-mapping", "paper", "--votf-refits", 0],
             "relief": [*ranks, "--relief", "estimated"],
             "neural": ["--method", "neural", "--channels", 8, "--steps", 60, *ranks[2:]]}
    models = {form: run.bake(f"{name}_{form}", "bake material", "--raw", raw, *options)
              for form, options in forms.items()}
    evaluate = ["evaluate", "material", raw]
    run.report(f"evaluate_{name}", *evaluate, model, "--compare-seeding", "--sweep", "8,16", "--unseen", unseen,
               "--images", f"{name}_plots", tool="nook-lab")
    run.report(f"evaluate_{name}_drawn", *evaluate, model, "--jumps", "--mipmaps", "--grazing", "--images",
               f"{name}_drawn")
    for form in ("rgtc", "eac"):
        run.report(f"evaluate_{name}_{form}", *evaluate, model, "--modes", form, "--whole-light-modes", 4)
    run.report(f"evaluate_{name}_relief", *evaluate, models["relief"], "--unseen", unseen)
    run.report(f"evaluate_{name}_neural", *evaluate, models["neural"], "--unseen", unseen, "--methods", "pca,pbr",
               "--mipmaps", "--grazing", tool="nook-lab")
    return model


def other_materials(run):
    small = ["--samples", 1, "--bounces", 0, "--ranks", "4,8,6,6", "--votf-ranks", "6,6"]
    trace = ["--texels", 12, "--directions", 16, *small]
    run.bake("roughhole", "bake material", "--meso", "roughhole", *trace, "--relief", "known")
    run.bake("fiber", "bake material", "--meso", "fiber", *trace, "--detail", 0.3)
    run.bake("tile", "bake material", "--meso", "tile.gltf", "--tile-size", 1, *trace)
    run.bake("mounds", "bake material", "--pbr", "mounds", "--height-scale", 0.2, *trace, "--relief",
             "mounds/mounds_height.ppm", "--keep-raw", "mounds.raw")
    run.bake("mounds_neural", "bake material", "--raw", "mounds.raw", "--method", "neural", "--channels", 4, "--steps",
             40, "--votf", "none")
    run.bake("measured", "bake material", "--btf", "measured", "--ranks", "4,6,4,4", "--cluster-rank", 2)


def synthesis(run, material_file):
    run.bake("plane", "bake synthesis", material_file, "--size", 64, "--passes", 2, "--images", "plane")
    run.bake("plane_crop", "bake synthesis", "weave.raw", "--size", 64, "--no-tile", "--crop", 0, 0, 16, 16, "--jitter",
             0.5, "--passes", 1)


def transfer(run, knot, hills, material_file, sky):
    small = ["--material", material_file, "--light", sky, "--width", 48, "--height", 36, "--paths", 16]
    model = run.bake("knot", "bake transfer", knot, "--ray-side", 8, "--lobes", 162)
    run.report("evaluate_knot", "evaluate", "transfer", knot, model, *small, "--without-suns", "--images",
               "knot_pictures")
    bake, evaluate = ["bake transfer", hills, "--ray-side", 8, "--lobes", 42], ["evaluate", "transfer", hills]
    model = run.bake("hills_holes", *bake, "--bounces", 2, "--votf", material_file, "--tiles", 4)
    run.report("evaluate_hills_holes", *evaluate, model, *small, "--tiles", 4, "--truth-bounces", 1, "--raw",
               "weave.raw")
    model = run.bake("hills_paper", *bake, "--form", "paper", "--material", material_file, "--clusters", 2,
                     "--lobe-rank", 16, "--vertex-rank", 6)
    run.report("evaluate_hills_paper", *evaluate, model, *small, "--no-pictures")


def networks(run):
    train = ["--scenes", 48, "--views", 48, "--points", 24, "--rays", 8, "--epochs", 2, "--batch", 32]
    horizon = run.bake("network_horizon", "train nnao", *train)
    paper = run.bake("network_paper", "train nnao", *train, "--form", "paper")
    run.report("train_specular", "train", "specular", "-o", "nnao_specular_numbers.h", "--scenes", 48, "--views", 48,
               "--points", 16, "--rays", 32, "--steps", 200)
    return horizon, paper


def screen_space(run, glb, recording, scenes):
    horizon, paper = networks(run)
    small = ["--size", "96x64", "--rays", 16, "--cameras", 1]
    tiny = ["--size", "64x48", "--rays", 8, "--cameras", 1]

    def lab(name, *arguments):
        run.report(name, "evaluate", "nnao", *arguments, tool="nook-lab")

    lab("evaluate_nnao_thin", "--thin", *small, "--network", paper, "--markdown", "nnao.md", "--images", "nnao_sheets")
    lab("evaluate_nnao_network", "--thin", *scenes, *small, "--network", horizon, "--methods",
        "nnao,nnao_file,gtao", "--max-radius-px", 20)
    lab("evaluate_nnao_oracle", "--thin", *tiny, "--methods", "nnao:16,oracle,oracle_bitmask", "--no-raw",
        "--radius", "thin:0.3", "--intensity", 1.5)
    lab("evaluate_nnao_views", "--views", "views.json", "--references", "references")
    lab("evaluate_nnao_bent", "--thin", *small, "--bent-normals")
    lab("evaluate_nnao_sequence", "--thin", *tiny, "--temporal", "--markdown", "sequence.md")
    lab("evaluate_nnao_mover", "--temporal", "--mover", glb, "--size", "40x30", "--rays", 4, "--cameras", 1,
        "--images", "nnao_mover", "--markdown", "mover.md")
    run.report("evaluate_nnao_frame", "evaluate", "nnao", "--frame", recording, "--images", "nnao_frame")
    lab("evaluate_nnao_tune", "--tune", "ssao")
    run.report("inspect_recording", "inspect", recording)


def pages(run, glb, recording):
    """The page of a file of each kind."""
    sources = {"mannequin": [glb, "--rays", 16, "--samples-per-clip", 1, "--licence", "made by code"],
               "sky_default": ["sky.hdr"], "mannequin_grid": [], "weave": ["weave.raw"], "weave_neural": [],
               "plane": [], "knot": ["knot.glb"], "network_horizon": [], "mannequin_clips": []}
    for name, options in sources.items():
        run.report(f"report_{name}", "report", f"{name}.nook", *options, "-o", f"{name}.html")
    run.report("report_recording", "report", recording, "-o", "recording.html")
