#include <nook/experimental/nook_sg.h>
#include <nook/nook_probe.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_lobe, 32);
NOOK_AT(nook_lobe, axis, 0);
NOOK_AT(nook_lobe, sharpness, 12);
NOOK_AT(nook_lobe, amplitude, 16);
NOOK_AT(nook_lobe, reserved, 28);

NOOK_SIZE(nook_probe_fit_desc, 88);
NOOK_AT(nook_probe_fit_desc, struct_size, 0);
NOOK_AT(nook_probe_fit_desc, type, 4);
NOOK_AT(nook_probe_fit_desc, next, 8);
NOOK_AT(nook_probe_fit_desc, method, 16);
NOOK_AT(nook_probe_fit_desc, form, 20);
NOOK_AT(nook_probe_fit_desc, match_sh, 24);
NOOK_AT(nook_probe_fit_desc, basis, 28);
NOOK_AT(nook_probe_fit_desc, domain, 32);
NOOK_AT(nook_probe_fit_desc, up, 36);
NOOK_AT(nook_probe_fit_desc, lobe_count, 48);
NOOK_AT(nook_probe_fit_desc, sharpness, 52);
NOOK_AT(nook_probe_fit_desc, axes, 56);
NOOK_AT(nook_probe_fit_desc, sharpnesses, 64);
NOOK_AT(nook_probe_fit_desc, ambient, 72);
NOOK_AT(nook_probe_fit_desc, order, 76);
NOOK_AT(nook_probe_fit_desc, growing_samples, 80);
NOOK_AT(nook_probe_fit_desc, reserved, 84);

NOOK_SIZE(nook_probe_fit_study_desc, 32);
NOOK_AT(nook_probe_fit_study_desc, struct_size, 0);
NOOK_AT(nook_probe_fit_study_desc, type, 4);
NOOK_AT(nook_probe_fit_study_desc, next, 8);
NOOK_AT(nook_probe_fit_study_desc, method, 16);
NOOK_AT(nook_probe_fit_study_desc, published_step, 20);
NOOK_AT(nook_probe_fit_study_desc, denominator, 24);
NOOK_AT(nook_probe_fit_study_desc, dice, 28);

NOOK_SIZE(nook_probe_fit_info, 80);
NOOK_AT(nook_probe_fit_info, struct_size, 0);
NOOK_AT(nook_probe_fit_info, function_count, 4);
NOOK_AT(nook_probe_fit_info, samples, 8);
NOOK_AT(nook_probe_fit_info, skipped, 16);
NOOK_AT(nook_probe_fit_info, skipped_direction, 24);
NOOK_AT(nook_probe_fit_info, skipped_radiance, 32);
NOOK_AT(nook_probe_fit_info, skipped_weight, 40);
NOOK_AT(nook_probe_fit_info, weight, 48);
NOOK_AT(nook_probe_fit_info, mean_radiance, 56);

NOOK_SIZE(nook_probe_desc, 96);
NOOK_AT(nook_probe_desc, struct_size, 0);
NOOK_AT(nook_probe_desc, type, 4);
NOOK_AT(nook_probe_desc, next, 8);
NOOK_AT(nook_probe_desc, counts, 16);
NOOK_AT(nook_probe_desc, origin_ws, 28);
NOOK_AT(nook_probe_desc, spacing_ws, 40);
NOOK_AT(nook_probe_desc, fit_count, 52);
NOOK_AT(nook_probe_desc, fits, 56);
NOOK_AT(nook_probe_desc, lobes, 64);
NOOK_AT(nook_probe_desc, lobe_count, 72);
NOOK_AT(nook_probe_desc, reserved, 76);
NOOK_AT(nook_probe_desc, functions, 80);
NOOK_AT(nook_probe_desc, coefficients, 88);

NOOK_SIZE(nook_probe_info, 80);
NOOK_AT(nook_probe_info, struct_size, 0);
NOOK_AT(nook_probe_info, basis, 4);
NOOK_AT(nook_probe_info, domain, 8);
NOOK_AT(nook_probe_info, up, 12);
NOOK_AT(nook_probe_info, function_count, 24);
NOOK_AT(nook_probe_info, ambient, 28);
NOOK_AT(nook_probe_info, order, 32);
NOOK_AT(nook_probe_info, probe_count, 36);
NOOK_AT(nook_probe_info, counts, 40);
NOOK_AT(nook_probe_info, origin_ws, 52);
NOOK_AT(nook_probe_info, spacing_ws, 64);
NOOK_AT(nook_probe_info, wall_cells, 76);

NOOK_SIZE(nook_probe_surface, 48);
NOOK_AT(nook_probe_surface, normal, 0);
NOOK_AT(nook_probe_surface, view, 12);
NOOK_AT(nook_probe_surface, tangent, 24);
NOOK_AT(nook_probe_surface, alpha_x, 36);
NOOK_AT(nook_probe_surface, alpha_y, 40);
NOOK_AT(nook_probe_surface, reflectance, 44);
