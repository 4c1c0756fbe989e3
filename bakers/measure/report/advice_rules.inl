// subject, measure, bound, threshold, meaning, advice. If a measure is beyond its threshold, it is worth an
// artist's time to change the bake. The page prints the threshold beside the measured value.

// Shares are shares of the visible error. Hands have about 5 % of a body's surface, feet 5 %, a head 10 %.
RULE(body, "source_changed", at_least, 1, "the hash of the character file differs from its hash at the bake",
     "The character file has changed since the bake, so the errors compare the old model with the new file. "
     "Bake it again.")
RULE(
    body, "rms_visible", at_most, 0.06, "typical error where the body is visible",
    "The typical error is {value}, which is hard to see in motion. Look at the worst places below before you "
    "spend more time on the bake.")
RULE(body, "draft", at_least, 1, "the preset of the bake is draft",
     "This is a draft bake. `nook bake character --preset standard` takes some minutes and has a smaller "
     "error.")
RULE(body, "fitted_clips", at_most, 0, "number of clips that the bake used",
     "The bake used none of the file's clips. `--poses all` also fits the model to the clips, so that it is "
     "most accurate in poses that the game shows.")
RULE(body, "hands_share", at_least, 0.25, "share of the visible error that is on hands and fingers",
     "{percent} of the visible error is on the hands. Give `--clips` the names of clips with fists and open "
     "hands. If hands are small on the screen, no change is needed.")
RULE(
    body, "feet_share", at_least, 0.25, "share of the visible error that is on the feet",
    "{percent} of the visible error is on the feet. Give `--clips` the names of clips in which the character "
    "crouches, kneels or stands on its toes.")
RULE(
    body, "head_share", at_least, 0.35, "share of the visible error that is on head and neck",
    "{percent} of the visible error is on head and neck. Often the cause is hair cards, eyes and teeth. They "
    "move with one bone, so give them a separate material with AO from a texture.")
RULE(body, "worst_clip_ratio", at_least, 1.5,
     "error of the worst clip, divided by the error of the median clip",
     "The error in the clip {clip} is {value} times the error in the median clip. If players see this clip "
     "often, fit it: give `--clips` its name and the names of similar clips.")
RULE(body, "too_dark", at_least, 0.02, "mean of the ray-traced AO minus the AO of the model",
     "On average, the AO of the model is too dark by {value}. In the shader, multiply the occlusion by a "
     "weight below 1 to hide most of this.")
RULE(body, "too_bright", at_least, 0.02, "mean of the AO of the model minus the ray-traced AO",
     "On average, the AO of the model is too bright by {value}. More proxy spheres (`--spheres`) or a higher "
     "preset reproduce more of the occlusion.")
RULE(body, "ratio_to_static", at_least, 0.5,
     "squared error, divided by the squared error of AO that is baked once into a texture",
     "If you bake AO once into a texture, its squared error is only {oneover} times the squared error of the "
     "model. The parts of this body hardly move relative to each other, and a texture is cheaper.")
RULE(body, "noise_share", at_least, 0.25, "share of the squared error that is noise of the measurement",
     "{percent} of the squared error is noise of the ray tracing. A larger `--rays` gives a more precise "
     "measurement.")
RULE(body, "hidden_share", at_least, 0.35, "share of the vertices that no light reaches, over all poses",
     "No light reaches {percent} of the vertices: they are inside the body or under clothes. Delete surfaces "
     "that are never seen. The model becomes smaller, and the bake places its key points on the rest.")
RULE(
    body, "world_casters", at_most, 0, "number of world casters, the capsules that darken floors and walls",
    "The model has no world casters, so the character does not darken floors and walls. Bake it again to add "
    "them.")
RULE(body, "poses", at_most, 19, "number of measured poses",
     "Only {value} poses were measured, so the lists of the worst clips and places are uncertain. Give a "
     "source file with more clips, or a larger `--samples-per-clip`.")

RULE(probes, "irradiance_minimum", at_most, -0.02, "lowest irradiance, in units of the map's mean",
     "Irradiance falls below 0 for some directions, which shows as black or coloured spots. Use more lobes "
     "(`--lobes`).")
RULE(probes, "irradiance_relative", at_least, 0.1, "error of irradiance, in units of the map's mean",
     "The light on surfaces is off by {percent}. Use more lobes (`--lobes`), or draw the sun as a separate "
     "light.")
RULE(probes, "irradiance_relative", at_most, 0.02, "error of irradiance, in units of the map's mean",
     "The light on surfaces is off by only {percent}. For diffuse surfaces, fewer lobes are enough. "
     "Reflections profit from more lobes.")
RULE(
    probes, "below_share", at_least, 0.005,
    "share of the directions of all probes in which irradiance is "
    "below 0",
    "Irradiance is below 0 in {percent} of the directions, which shows as black patches. The cause is strong "
    "light from few directions. Use more lobes (`--lobes`), or draw the sun as a separate light "
    "(`--direct`).")
RULE(probes, "dark_share", at_least, 0.2, "share of the probes with less than a hundredth of the mean light",
     "{percent} of the probes are black. They may be inside walls: change the counts in `--grid`.")
RULE(probes, "probes", at_least, 20000, "number of probes in the file",
     "The grid has {value} probes. With twice the spacing, it takes an eighth of the memory. Try this where "
     "rooms are large.")

RULE(material, "se_db", at_most, 25, "signal-to-error ratio in decibels",
     "The signal-to-error ratio of the compression is {value} dB; you can see differences side by side. Use "
     "higher `--ranks` or more `--clusters`.")
RULE(material, "bytes", at_least, 16e6, "bytes of the file",
     "The file is large. First lower `--ranks`: the size grows with each rank.")
RULE(material, "negative_share", at_least, 0.02,
     "share of the texels in the pictures whose radiance is below "
     "-0.02 (white has 1)",
     "{percent} of the texels in these pictures have negative radiance, which shaders clamp to black. Use "
     "higher `--ranks`.")

RULE(transfer, "open_share", at_least, 0.9,
     "mean share of light that reaches a vertex, over the lobes of its side",
     "This shape hardly shadows itself ({percent} of the light arrives). A light probe alone looks the same, "
     "and then you need no transfer file.")
RULE(transfer, "bytes_per_vertex", at_least, 1000, "bytes in the file per vertex",
     "Each vertex takes {value} bytes. Fewer lobes (`--lobes`) take less; 162 are enough for soft light.")
RULE(
    transfer, "bounces", at_most, 0, "number of bounces of light in the file",
    "The file contains only direct light, so caves and folds are too dark. `--bounces 2` adds the light that "
    "the shape reflects onto itself.")

RULE(frame, "not_finite", at_least, 1, "number of pixels whose recorded AO or depth is not a number",
     "In some pixels, AO or depth is not a number: the application wrote NaN or infinity into its depth or "
     "normals.")
RULE(frame, "sky_share", at_least, 0.95, "share of the pixels without a surface",
     "The frame is nearly empty ({percent} sky). Check the projection, the clip range and `depth_kind`.")
RULE(frame, "reach_share", at_least, 0.5, "share of the pixels in which max_radius_px limits the radius",
     "`max_radius_px` limits the radius in {percent} of the pixels, so near surfaces lose occlusion. Use a "
     "larger `max_radius_px` or a smaller radius.")
RULE(frame, "small_share", at_least, 0.5, "share of the pixels in which the radius is below two pixels",
     "In {percent} of the pixels, the radius is below two pixels, so the pass cannot darken anything there. "
     "Use a larger radius, or check that depth is in metres.")
RULE(frame, "ao_mean", at_most, 0.4, "mean of the recorded AO",
     "The picture is dark: the mean AO is {value}. Check the radius against the size of the scene, and "
     "`intensity` and `power`.")
RULE(frame, "ao_mean", at_least, 0.995, "mean of the recorded AO",
     "Almost nothing is darkened: the mean AO is {value}. Check the radius against the size of the scene.")
