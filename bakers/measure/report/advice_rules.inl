// subject, measure, bound, threshold, meaning, advice. Beyond its threshold, a change of the bake is worth an
// artist's time. The page prints the threshold beside the measured value.

// Shares are shares of the visible error. Hands have about 5 % of a body's surface, feet 5 %, a head 10 %.
RULE(body, "source_changed", at_least, 1, "the character file has another hash than at the bake",
     "The character file has changed since the bake, so that the numbers mix old and new. Bake it again.")
RULE(body, "rms_visible", at_most, 0.06, "typical error where the body is visible",
     "The typical error is {value}, a difference that is hard to see in motion. Look at the worst places "
     "below before you spend more time on the bake.")
RULE(body, "draft", at_least, 1, "the preset of the bake is draft",
     "This is a draft bake. `nook bake character --preset standard` takes some minutes and has a smaller "
     "error.")
RULE(body, "fitted_clips", at_most, 0, "clips that the bake has seen",
     "The bake has seen none of the file's clips. `--poses all` fits the model to them as well, and it is "
     "then best where the game shows it.")
RULE(body, "hands_share", at_least, 0.25, "share of the hands and fingers in what is seen wrong",
     "The hands hold {percent} of what is seen wrong. Give clips with fists and open hands to `--clips`; if "
     "hands are small on the screen, leave it.")
RULE(body, "feet_share", at_least, 0.25, "share of the feet in what is seen wrong",
     "The feet hold {percent} of what is seen wrong. Give clips that crouch, kneel and stand on toes.")
RULE(body, "head_share", at_least, 0.35, "share of head and neck in what is seen wrong",
     "Head and neck hold {percent} of what is seen wrong. Hair cards, eyes and teeth are often the cause: "
     "they move with one bone, and a material of their own with AO from a texture serves them better.")
RULE(body, "worst_clip_ratio", at_least, 1.5,
     "error of the worst clip as a multiple of the middle clip's error",
     "The clip {clip} is {value} times as wrong as the middle one. If players see it often, fit it: "
     "`--clips` with its name and the names of clips like it.")
RULE(body, "too_dark", at_least, 0.02, "mean of ray traced less model",
     "The model is too dark, by {value} of AO on average. A weight of less than 1 on its occlusion in the "
     "shader hides most of it.")
RULE(body, "too_bright", at_least, 0.02, "mean of model less ray traced",
     "The model is too bright, by {value} of AO on average. More proxy spheres (`--spheres`) or a higher "
     "preset find more of the occlusion.")
RULE(body, "ratio_to_static", at_least, 0.5,
     "squared error as a share of the error of AO baked once into a texture",
     "AO that is baked once into a texture has only {oneover} times the squared error: this body hardly "
     "moves against itself, and the texture is cheaper.")
RULE(body, "noise_share", at_least, 0.25, "share of the measurement's own noise in the squared error",
     "A share of {percent} of the squared error is noise of the ray tracing. `--rays` with a larger number "
     "measures more finely.")
RULE(body, "hidden_share", at_least, 0.35, "vertices that no light reaches, of all in all poses",
     "No light reaches {percent} of the vertices: they are inside the body or under clothes. Delete what is "
     "never seen; the model becomes smaller, and the bake spends its key points on the rest.")
RULE(body, "world_casters", at_most, 0, "capsules for darkening floors and walls",
     "The model has no casters, so that it leaves floors and walls bright. A new bake makes them.")
RULE(body, "poses", at_most, 19, "poses that were measured",
     "Only {value} poses were measured, so that lists of the worst are uncertain. Give a source with more "
     "clips, or a larger `--samples-per-clip`.")

RULE(probes, "irradiance_minimum", at_most, -0.02, "lowest irradiance, in units of the map's mean",
     "Irradiance falls below 0 for some directions, which shows as black or coloured spots. More lobes "
     "(`--lobes`) avoid it.")
RULE(probes, "irradiance_relative", at_least, 0.1, "error of irradiance, in units of the map's mean",
     "The light on surfaces is off by {percent}. Give more lobes (`--lobes`), or draw the sun as a light of "
     "its own.")
RULE(probes, "irradiance_relative", at_most, 0.02, "error of irradiance, in units of the map's mean",
     "The light on surfaces is off by {percent} only. Fewer lobes would do for diffuse surfaces; reflections "
     "use the rest.")
RULE(probes, "below_share", at_least, 0.005, "directions of all probes whose irradiance is below 0",
     "Irradiance is below 0 in {percent} of the directions, which shows as black patches. A strong light in "
     "few directions does it: more lobes (`--lobes`), or the sun as a light of its own (`--direct`).")
RULE(probes, "dark_share", at_least, 0.2, "probes with less than a hundredth of the mean light",
     "A share of {percent} of the probes is black. They may be inside walls: change the counts of `--grid`.")
RULE(probes, "probes", at_least, 20000, "probes in the file",
     "The grid has {value} probes. Twice the spacing takes an eighth of the memory; try it where rooms are "
     "large.")

RULE(material, "se_db", at_most, 25, "signal to error, decibels",
     "The compression is at {value} dB, where differences are seen side by side. Higher `--ranks` or more "
     "`--clusters` help.")
RULE(material, "bytes", at_least, 16e6, "bytes of the file",
     "The file is large. Lower `--ranks` first: bytes grow with each of them.")
RULE(material, "negative_share", at_least, 0.02, "texels of the pictures that are darker than -0.02 of white",
     "A share of {percent} of the texels of these pictures has negative radiance, which shaders clamp to "
     "black. Higher `--ranks` help.")

RULE(transfer, "open_share", at_least, 0.9,
     "mean share of light that reaches a vertex, over the lobes of its side",
     "This shape shadows itself hardly at all ({percent} of the light arrives). A light probe alone looks "
     "the same and takes no memory.")
RULE(transfer, "bytes_per_vertex", at_least, 1000, "bytes of the file for each vertex",
     "Each vertex takes {value} bytes. Fewer `--lobes` take less; 162 are enough for soft light.")
RULE(transfer, "bounces", at_most, 0, "reflections in the file",
     "The file has direct light alone, so that caves and folds are too dark. `--bounces 2` adds what the "
     "shape reflects onto itself.")

RULE(frame, "not_finite", at_least, 1, "pixels whose recorded AO or depth is not a number",
     "Some pixels hold no number: the host wrote NaN or infinity into its depth or normals.")
RULE(frame, "sky_share", at_least, 0.95, "pixels without a surface",
     "The frame is nearly empty ({percent} sky). Check the projection, the clip range and `depth_kind`.")
RULE(frame, "reach_share", at_least, 0.5, "pixels in which the radius is cut by max_radius_px",
     "The radius is cut short by `max_radius_px` in {percent} of the pixels, so that near surfaces lose "
     "occlusion. Raise it, or take a smaller radius.")
RULE(frame, "small_share", at_least, 0.5, "pixels in which the radius is below two pixels",
     "In {percent} of the pixels the radius is below two pixels, where nothing can be darkened. Take a "
     "larger radius, or check that depth is in metres.")
RULE(frame, "ao_mean", at_most, 0.4, "mean of the recorded AO",
     "The picture is dark: the mean AO is {value}. Check the radius against the size of the scene, and "
     "`intensity` and `power`.")
RULE(frame, "ao_mean", at_least, 0.995, "mean of the recorded AO",
     "Almost nothing is darkened: the mean AO is {value}. Check the radius against the size of the scene.")
