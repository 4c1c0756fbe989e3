"""Made from the public C headers by read_headers.py; do not edit."""
import ctypes
from typing import Any, Dict, List, Tuple

NOOK_ALL_PRIMITIVES = -1
NOOK_BAKE_ARRAY_FRAMES = 1
NOOK_BAKE_ARRAY_JOINTS = 6
NOOK_BAKE_ARRAY_NORMALS = 4
NOOK_BAKE_ARRAY_PARENTS = 0
NOOK_BAKE_ARRAY_POSITIONS = 3
NOOK_BAKE_ARRAY_PRIMITIVES = 2
NOOK_BAKE_ARRAY_TRIANGLES = 5
NOOK_BAKE_ARRAY_WEIGHTS = 7
NOOK_BAKE_DONE = 2
NOOK_BAKE_GAMMA_LEARNED = -1.0
NOOK_BAKE_KEY_SIZE = 65
NOOK_BAKE_METHOD_CTA = 1
NOOK_BAKE_METHOD_K_CTA = 0
NOOK_BAKE_METHOD_NEURAL = 3
NOOK_BAKE_METHOD_N_SVD = 2
NOOK_BAKE_NAME_BONE = 0
NOOK_BAKE_NAME_CLIP = 1
NOOK_BAKE_NAME_PRIMITIVE = 2
NOOK_BAKE_NAME_WARNING = 3
NOOK_BAKE_POSES_ALL = 3
NOOK_BAKE_POSES_AUTO = 0
NOOK_BAKE_POSES_CLIPS = 2
NOOK_BAKE_POSES_EXTRA = 4
NOOK_BAKE_POSES_SINGLE_JOINT = 1
NOOK_BAKE_PRESET_DRAFT = 0
NOOK_BAKE_PRESET_PRODUCTION = 2
NOOK_BAKE_PRESET_STANDARD = 1
NOOK_BAKE_RUNNING = 1
NOOK_BAKE_SPLIT_ALL = 0
NOOK_BAKE_SPLIT_FAMILIES = 2
NOOK_BAKE_SPLIT_HALF = 1
NOOK_BAKE_UNSATURATED = -1.0
NOOK_BAKE_WAITING = 0
NOOK_BONE_MAP_DROP_SHARED_PREFIX = 2
NOOK_BONE_MAP_LOOSE = 1
NOOK_CHANNEL_AO = 0
NOOK_CHANNEL_BENT_NORMAL = 2
NOOK_CHANNEL_DIRECTIONAL_AO = 1
NOOK_DESC_BAKE_BENT = 14
NOOK_DESC_BAKE_CHARACTER = 13
NOOK_DESC_BAKE_CHARACTER_STUDY = 29
NOOK_DESC_BAKE_CLIPS = 15
NOOK_DESC_BAKE_IRRADIANCE = 25
NOOK_DESC_BAKE_MATERIAL = 16
NOOK_DESC_BAKE_SOURCE = 12
NOOK_DESC_BAKE_SYNTHESIS = 17
NOOK_DESC_BAKE_TRACE = 24
NOOK_DESC_BAKE_TRANSFER = 18
NOOK_DESC_BONE_MAP = 26
NOOK_DESC_CONTEXT = 1
NOOK_DESC_GL = 4
NOOK_DESC_GL_CAPTURE = 21
NOOK_DESC_GL_FRAME = 33
NOOK_DESC_MATERIAL = 11
NOOK_DESC_NNAO = 5
NOOK_DESC_NNAO_DEBUG = 34
NOOK_DESC_NNAO_FRAME = 6
NOOK_DESC_NNAO_FRAME_DEBUG = 35
NOOK_DESC_NNAO_RECORDING = 19
NOOK_DESC_POSE = 3
NOOK_DESC_POSE_CHECK = 28
NOOK_DESC_PROBE = 10
NOOK_DESC_PROBE_FIT = 9
NOOK_DESC_PROBE_FIT_STUDY = 32
NOOK_DESC_SCENE = 2
NOOK_DESC_TRANSFER_LIGHT = 22
NOOK_DESC_TRANSFER_MESH = 30
NOOK_DESC_TRANSFER_RESPONSE = 23
NOOK_DESC_TRANSFER_VECTORS = 31
NOOK_DESC_VERTEX_MATCH = 27
NOOK_DESC_WORLD = 7
NOOK_DESC_WORLD_FRAME = 8
NOOK_DESC_WORLD_FRAME_DEBUG = 36
NOOK_DESC_WORLD_SAMPLE = 20
NOOK_ERROR_BAD_FILE = -4
NOOK_ERROR_CANCELLED = -9
NOOK_ERROR_FILE_VERSION = -5
NOOK_ERROR_GL = -8
NOOK_ERROR_INTERNAL = -10
NOOK_ERROR_INVALID_ARGUMENT = -1
NOOK_ERROR_INVALID_HANDLE = -2
NOOK_ERROR_OUT_OF_MEMORY = -3
NOOK_ERROR_UNSUPPORTED = -7
NOOK_ERROR_VERSION = -6
NOOK_FORMAT_FLOAT = 0
NOOK_FORMAT_HALF = 1
NOOK_FORMAT_SNORM8 = 3
NOOK_FORMAT_UNORM8 = 2
NOOK_FORM_DEFAULT = 0
NOOK_FORM_PAPER = 1
NOOK_ISA_AUTO = 0
NOOK_ISA_AVX2 = 3
NOOK_ISA_AVX512 = 4
NOOK_ISA_NEON = 5
NOOK_ISA_SCALAR = 1
NOOK_ISA_SSE2 = 2
NOOK_ISA_WASM128 = 6
NOOK_LOG_ERROR = 2
NOOK_LOG_INFO = 0
NOOK_LOG_WARNING = 1
NOOK_MATERIAL_BLOCKS_EAC = 2
NOOK_MATERIAL_BLOCKS_NONE = 0
NOOK_MATERIAL_BLOCKS_RGTC = 1
NOOK_MATERIAL_MAX_FETCHES = 8
NOOK_MATERIAL_VISIBILITY_DISTANCE = 2
NOOK_MATERIAL_VISIBILITY_MASK = 1
NOOK_MATERIAL_VISIBILITY_NONE = 0
NOOK_MODEL_OCCLUDED_DIRECTIONS = 1
NOOK_MODEL_STATIC_AO = 0
NOOK_NNAO_PATH_AUTOMATIC = 0
NOOK_NNAO_PATH_COMPUTE = 2
NOOK_NNAO_PATH_FRAGMENT = 1
NOOK_NNAO_SAMPLE_FIRST = 1
NOOK_NNAO_SAMPLE_MEDIAN = 0
NOOK_NNAO_SAMPLE_NEAREST = 2
NOOK_NNAO_VIEW_AO = 0
NOOK_NNAO_VIEW_BLURRED = 2
NOOK_NNAO_VIEW_NORMALS = 3
NOOK_NNAO_VIEW_RAW = 1
NOOK_OK = 0
NOOK_POSE_FAULT_INVERTED = 8
NOOK_POSE_FAULT_KIND = 3
NOOK_POSE_FAULT_NONE = 0
NOOK_POSE_FAULT_NO_BIND = 2
NOOK_POSE_FAULT_ORDER = 5
NOOK_POSE_FAULT_PLACE = 7
NOOK_POSE_FAULT_SKIN = 4
NOOK_POSE_FAULT_TRANSPOSED = 1
NOOK_POSE_FAULT_UNIT = 6
NOOK_POSE_FAULT_UNKNOWN = 9
NOOK_POSE_FLAG_PARTIAL = 1
NOOK_POSE_FLAG_STRICT = 2
NOOK_POSE_FLAG_SURPLUS = 4
NOOK_POSE_JOINT_TO_WORLD = 1
NOOK_POSE_REST_TO_WORLD = 0
NOOK_POSE_SKINNING = 2
NOOK_PROBE_BASIS_DICE = 2
NOOK_PROBE_BASIS_LOBES = 0
NOOK_PROBE_BASIS_SH = 1
NOOK_PROBE_DENOMINATOR_LOCKSTEP = 0
NOOK_PROBE_DENOMINATOR_PRECOMPUTED = 1
NOOK_PROBE_DOMAIN_HEMISPHERE = 1
NOOK_PROBE_DOMAIN_SPHERE = 0
NOOK_PROBE_FIT_LEAST_SQUARES = 0
NOOK_PROBE_FIT_LEAST_SQUARES_NON_NEGATIVE = 1
NOOK_PROBE_FIT_RUNNING_AVERAGE = 2
NOOK_PROBE_FIT_RUNNING_AVERAGE_NON_NEGATIVE = 3
NOOK_PROBE_FIT_STUDY_DEFAULT = 0
NOOK_PROBE_FIT_STUDY_MOMENTS = 3
NOOK_PROBE_FIT_STUDY_NAIVE = 1
NOOK_PROBE_FIT_STUDY_RUNNING_AVERAGE_ORIGINAL = 2
NOOK_PROBE_IRRADIANCE_BANDS = 2
NOOK_PROBE_IRRADIANCE_FITTED = 0
NOOK_PROBE_IRRADIANCE_INNER_PRODUCT = 1
NOOK_PROBE_MAX_FUNCTIONS = 64
NOOK_PROBE_PACKING_FLOAT = 0
NOOK_PROBE_PACKING_HALF = 1
NOOK_PROBE_PACKING_RGB9E5 = 2
NOOK_PROBE_SPECULAR_ANISOTROPIC = 1
NOOK_PROBE_SPECULAR_ISOTROPIC = 0
NOOK_SH_ZH3 = 100
NOOK_TERM_ALL = 15
NOOK_TERM_GROUND = 4
NOOK_TERM_LINKS = 2
NOOK_TERM_OCCLUDERS = 8
NOOK_TERM_SELF = 1
NOOK_TRANSFER_MAP_CUBE = 1
NOOK_TRANSFER_MAP_LATLONG = 0
NOOK_TRANSFORM_COLUMNS_4X3 = 3
NOOK_TRANSFORM_COLUMNS_4X4 = 2
NOOK_TRANSFORM_DUAL_QUATERNION = 4
NOOK_TRANSFORM_ROWS_3X4 = 0
NOOK_TRANSFORM_ROWS_4X4 = 1
NOOK_TRANSFORM_TRS = 5
NOOK_VERSION = ((1 << 22) | (0 << 12) | 0)
NOOK_VERSION_MAJOR = 1
NOOK_VERSION_MINOR = 0
NOOK_VERSION_PATCH = 0
NOOK_VERSION_SUFFIX = "-rc1"
NOOK_WORLD_CONE_PARTS = 16
NOOK_WORLD_MAX_CASTERS = 64
NOOK_WORLD_VIEW_AO = 0
NOOK_WORLD_VIEW_CASTERS = 1
NOOK_WORLD_VIEW_EXACT_CASTERS = 2
NOOK_WORLD_VIEW_FAR_CASTERS = 4
NOOK_WORLD_VIEW_FAR_TESTS = 5
NOOK_WORLD_VIEW_TESTS = 3
nook_result = ctypes.c_int32


class nook_allocator(ctypes.Structure):
    _fields_ = [
        ("user", ctypes.c_void_p),
        ("allocate", ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_size_t)),
        ("release", ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_size_t)),
    ]


nook_log_severity = ctypes.c_int32
nook_log_fn = ctypes.CFUNCTYPE(None, ctypes.c_void_p, nook_log_severity, ctypes.c_char_p)
nook_job_fn = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_uint32)
nook_parallel_for_fn = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_uint32, nook_job_fn, ctypes.c_void_p)
nook_isa = ctypes.c_int32
nook_form = ctypes.c_int32
nook_channel = ctypes.c_int32
nook_format = ctypes.c_int32


class nook_context(ctypes.c_void_p):
    pass


class nook_model(ctypes.c_void_p):
    pass


class nook_scene(ctypes.c_void_p):
    pass


class nook_clips(ctypes.c_void_p):
    pass


class nook_probe_fit(ctypes.c_void_p):
    pass


class nook_probe(ctypes.c_void_p):
    pass


class nook_material(ctypes.c_void_p):
    pass


class nook_gl(ctypes.c_void_p):
    pass


class nook_gl_upload(ctypes.c_void_p):
    pass


class nook_nnao(ctypes.c_void_p):
    pass


class nook_world(ctypes.c_void_p):
    pass


class nook_bake_character(ctypes.c_void_p):
    pass


class nook_bake_job(ctypes.c_void_p):
    pass


class nook_range(ctypes.Structure):
    _fields_ = [
        ("first", ctypes.c_uint32),
        ("count", ctypes.c_uint32),
    ]


class nook_lobe(ctypes.Structure):
    _fields_ = [
        ("axis", ctypes.c_float * 3),
        ("sharpness", ctypes.c_float),
        ("amplitude", ctypes.c_float * 3),
        ("reserved", ctypes.c_float),
    ]


class nook_context_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("allocator", nook_allocator),
        ("log", nook_log_fn),
        ("log_user", ctypes.c_void_p),
        ("parallel_for", nook_parallel_for_fn),
        ("parallel_for_user", ctypes.c_void_p),
        ("isa", nook_isa),
        ("units_per_metre", ctypes.c_float),
    ]


nook_probe_basis = ctypes.c_int32
nook_probe_domain = ctypes.c_int32
nook_probe_method = ctypes.c_int32


class nook_probe_fit_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("method", nook_probe_method),
        ("form", nook_form),
        ("match_sh", ctypes.c_int32),
        ("basis", nook_probe_basis),
        ("domain", nook_probe_domain),
        ("up", ctypes.c_float * 3),
        ("lobe_count", ctypes.c_uint32),
        ("sharpness", ctypes.c_float),
        ("axes", ctypes.POINTER(ctypes.c_float)),
        ("sharpnesses", ctypes.POINTER(ctypes.c_float)),
        ("ambient", ctypes.c_int32),
        ("order", ctypes.c_uint32),
        ("growing_samples", ctypes.c_float),
        ("reserved", ctypes.c_uint32),
    ]


class nook_probe_fit_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("function_count", ctypes.c_uint32),
        ("samples", ctypes.c_uint64),
        ("skipped", ctypes.c_uint64),
        ("skipped_direction", ctypes.c_uint64),
        ("skipped_radiance", ctypes.c_uint64),
        ("skipped_weight", ctypes.c_uint64),
        ("weight", ctypes.c_double),
        ("mean_radiance", ctypes.c_double * 3),
    ]


class nook_probe_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("counts", ctypes.c_uint32 * 3),
        ("origin_ws", ctypes.c_float * 3),
        ("spacing_ws", ctypes.c_float * 3),
        ("fit_count", ctypes.c_uint32),
        ("fits", ctypes.POINTER(nook_probe_fit)),
        ("lobes", ctypes.POINTER(nook_lobe)),
        ("lobe_count", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("functions", nook_probe_fit),
        ("coefficients", ctypes.POINTER(ctypes.c_float)),
    ]


nook_probe_packing = ctypes.c_int32


class nook_probe_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("basis", nook_probe_basis),
        ("domain", nook_probe_domain),
        ("up", ctypes.c_float * 3),
        ("function_count", ctypes.c_uint32),
        ("ambient", ctypes.c_int32),
        ("order", ctypes.c_uint32),
        ("probe_count", ctypes.c_uint32),
        ("counts", ctypes.c_uint32 * 3),
        ("origin_ws", ctypes.c_float * 3),
        ("spacing_ws", ctypes.c_float * 3),
        ("wall_cells", ctypes.c_uint32),
    ]


nook_instance_id = ctypes.c_uint32
nook_occluder_id = ctypes.c_uint32


class nook_model_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("bone_count", ctypes.c_uint32),
        ("sphere_count", ctypes.c_uint32),
        ("key_point_count", ctypes.c_uint32),
        ("vertex_count", ctypes.c_uint32),
        ("file_vertex_count", ctypes.c_uint32),
        ("primitive_count", ctypes.c_uint32),
        ("lod_count", ctypes.c_uint32),
        ("bounding_radius", ctypes.c_float),
        ("gamma", ctypes.c_float),
        ("skin_count", ctypes.c_uint32),
        ("check_vertex_count", ctypes.c_uint32),
        ("model_bytes", ctypes.c_uint64),
        ("instance_bytes", ctypes.c_uint64),
        ("lit_instance_bytes", ctypes.c_uint64),
    ]


nook_model_array = ctypes.c_int32


class nook_scene_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("form", nook_form),
        ("cutoff_error", ctypes.c_float),
        ("lod_error", ctypes.c_float),
        ("lod_distance", ctypes.c_float),
        ("lod_max_interval", ctypes.c_uint32),
        ("ground_radius", ctypes.c_float),
        ("strict_poses", ctypes.c_uint32),
        ("far_error", ctypes.c_float),
    ]


class nook_occluder(ctypes.Structure):
    _fields_ = [
        ("centre_ws", ctypes.c_float * 3),
        ("radius", ctypes.c_float),
        ("receiver", nook_instance_id),
    ]


class nook_scene_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("instances", ctypes.c_uint32),
        ("instances_updated", ctypes.c_uint32),
        ("links", ctypes.c_uint32),
        ("links_culled", ctypes.c_uint32),
        ("uneven_instances", ctypes.c_uint32),
        ("evaluations", ctypes.c_uint64),
        ("memory_bytes", ctypes.c_uint64),
    ]


nook_pose_kind = ctypes.c_int32
nook_transform_layout = ctypes.c_int32


class nook_pose_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("kind", nook_pose_kind),
        ("layout", nook_transform_layout),
        ("transforms", ctypes.POINTER(ctypes.c_float)),
        ("stride", ctypes.c_size_t),
        ("transform_count", ctypes.c_uint32),
        ("skin", ctypes.c_uint32),
        ("transform_of_bone", ctypes.POINTER(ctypes.c_int32)),
        ("bone_count", ctypes.c_uint32),
        ("flags", ctypes.c_uint32),
        ("place_3x4", ctypes.POINTER(ctypes.c_float)),
    ]


class nook_bone_map_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("names", ctypes.POINTER(ctypes.c_char_p)),
        ("name_count", ctypes.c_uint32),
        ("flags", ctypes.c_uint32),
        ("host_prefix", ctypes.c_char_p),
        ("host_suffix", ctypes.c_char_p),
        ("model_prefix", ctypes.c_char_p),
        ("model_suffix", ctypes.c_char_p),
    ]


class nook_skin_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("file_index", ctypes.c_uint32),
        ("joint_count", ctypes.c_uint32),
        ("rest_from_mesh_3x4", ctypes.c_float * 12),
    ]


class nook_check_vertex_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("vertex", ctypes.c_uint32),
        ("position", ctypes.c_float * 3),
        ("mesh_position", ctypes.c_float * 3),
        ("bone", ctypes.c_uint32),
    ]


nook_pose_fault = ctypes.c_int32


class nook_pose_check_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("stride", ctypes.c_size_t),
        ("check_vertices", ctypes.POINTER(ctypes.c_uint32)),
        ("place_3x4", ctypes.POINTER(ctypes.c_float)),
        ("vertex_count", ctypes.c_uint32),
        ("tolerance", ctypes.c_float),
    ]


class nook_pose_check_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("fault", nook_pose_fault),
        ("max_error", ctypes.c_float),
        ("rms_error", ctypes.c_float),
        ("worst_bone", ctypes.c_uint32),
        ("fitting_skin", ctypes.c_uint32),
        ("scale", ctypes.c_float),
        ("text", ctypes.c_char * 512),
    ]


class nook_vertex_match_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("position_stride", ctypes.c_size_t),
        ("normals", ctypes.POINTER(ctypes.c_float)),
        ("normal_stride", ctypes.c_size_t),
        ("vertex_count", ctypes.c_uint32),
        ("primitive", ctypes.c_int32),
        ("in_rest_space", ctypes.c_uint32),
        ("tolerance", ctypes.c_float),
        ("joints", ctypes.POINTER(ctypes.c_uint16)),
        ("joint_stride", ctypes.c_size_t),
        ("weights", ctypes.POINTER(ctypes.c_float)),
        ("weight_stride", ctypes.c_size_t),
        ("influences", ctypes.c_uint32),
        ("skin", ctypes.c_uint32),
    ]


class nook_vertex_match_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("unmatched", ctypes.c_uint32),
        ("ambiguous", ctypes.c_uint32),
        ("text", ctypes.c_char * 320),
    ]


class nook_capsule(ctypes.Structure):
    _fields_ = [
        ("a", ctypes.c_float * 3),
        ("radius_a", ctypes.c_float),
        ("b", ctypes.c_float * 3),
        ("radius_b", ctypes.c_float),
    ]


nook_material_visibility = ctypes.c_int32
nook_material_blocks = ctypes.c_int32


class nook_material_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("blocks", nook_material_blocks),
        ("whole_light_modes", ctypes.c_int32),
    ]


class nook_material_tensor(ctypes.Structure):
    _fields_ = [
        ("rank_light", ctypes.c_uint32),
        ("rank_view", ctypes.c_uint32),
        ("rank_x", ctypes.c_uint32),
        ("rank_y", ctypes.c_uint32),
        ("clusters", ctypes.c_uint32),
        ("mixture", ctypes.c_uint32),
        ("view_map_side", ctypes.c_uint32),
        ("terms", ctypes.c_uint32),
    ]


class nook_material_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("visibility", nook_material_visibility),
        ("visibility_threshold", ctypes.c_float),
        ("visibility_weight", ctypes.c_float),
        ("light_count", ctypes.c_uint32),
        ("view_count", ctypes.c_uint32),
        ("width", ctypes.c_uint32),
        ("height", ctypes.c_uint32),
        ("btf", nook_material_tensor),
        ("votf", nook_material_tensor),
        ("decode_fetches", ctypes.c_uint32),
        ("decode_multiply_adds", ctypes.c_uint32),
        ("light_fetches", ctypes.c_uint32),
        ("light_multiply_adds", ctypes.c_uint32),
        ("occlusion_fetches", ctypes.c_uint32),
        ("occlusion_multiply_adds", ctypes.c_uint32),
        ("compressed_bytes", ctypes.c_uint64),
        ("view_map_bytes", ctypes.c_uint64),
        ("table_bytes", ctypes.c_uint64),
        ("neural_channels", ctypes.c_uint32),
        ("neural_units", ctypes.c_uint32),
        ("further_decode_fetches", ctypes.c_uint32),
        ("further_occlusion_fetches", ctypes.c_uint32),
    ]


class nook_material_value(ctypes.Structure):
    _fields_ = [
        ("radiance", ctypes.c_float * 3),
        ("occlusion", ctypes.c_float),
        ("visibility", ctypes.c_float),
    ]


class nook_material_pixel(ctypes.Structure):
    _fields_ = [
        ("uv", ctypes.c_float * 2),
        ("dx", ctypes.c_float * 2),
        ("dy", ctypes.c_float * 2),
        ("view", ctypes.c_float * 3),
        ("light", ctypes.c_float * 3),
    ]


nook_bake_state = ctypes.c_int32


class nook_bake_progress(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("state", nook_bake_state),
        ("stage", ctypes.c_char_p),
        ("done", ctypes.c_uint64),
        ("total", ctypes.c_uint64),
    ]


nook_bake_progress_fn = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.POINTER(nook_bake_progress))


class nook_bake_source_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("path", ctypes.c_char_p),
        ("bytes", ctypes.c_void_p),
        ("byte_count", ctypes.c_size_t),
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("indices", ctypes.POINTER(ctypes.c_uint32)),
        ("joints", ctypes.POINTER(ctypes.c_uint16)),
        ("weights", ctypes.POINTER(ctypes.c_float)),
        ("vertex_count", ctypes.c_uint32),
        ("index_count", ctypes.c_uint32),
        ("influences", ctypes.c_uint32),
        ("bone_count", ctypes.c_uint32),
        ("bone_names", ctypes.POINTER(ctypes.c_char_p)),
        ("bone_parents", ctypes.POINTER(ctypes.c_int32)),
        ("bone_frames_3x4", ctypes.POINTER(ctypes.c_float)),
        ("primitives", ctypes.POINTER(nook_range)),
        ("primitive_count", ctypes.c_uint32),
        ("meshes", ctypes.POINTER(ctypes.c_char_p)),
        ("without", ctypes.POINTER(ctypes.c_char_p)),
        ("mesh_count", ctypes.c_uint32),
        ("without_count", ctypes.c_uint32),
        ("allow_outside_files", ctypes.c_int32),
    ]


class nook_bake_character_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("vertex_count", ctypes.c_uint32),
        ("file_vertex_count", ctypes.c_uint32),
        ("triangle_count", ctypes.c_uint32),
        ("bone_count", ctypes.c_uint32),
        ("clip_count", ctypes.c_uint32),
        ("primitive_count", ctypes.c_uint32),
        ("warning_count", ctypes.c_uint32),
        ("bounds_min", ctypes.c_float * 3),
        ("bounds_max", ctypes.c_float * 3),
    ]


nook_bake_name = ctypes.c_int32
nook_bake_array = ctypes.c_int32
nook_bake_preset = ctypes.c_int32
nook_bake_pose_mode = ctypes.c_int32


class nook_bake_character_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("character", nook_bake_character),
        ("preset", nook_bake_preset),
        ("spheres", ctypes.c_uint32),
        ("key_points", ctypes.c_uint32),
        ("rays", ctypes.c_uint32),
        ("steps", ctypes.c_uint32),
        ("pose_mode", nook_bake_pose_mode),
        ("auto_pose_count", ctypes.c_uint32),
        ("samples_per_clip", ctypes.c_uint32),
        ("clip_count", ctypes.c_uint32),
        ("extra_pose_count", ctypes.c_uint32),
        ("clip_names", ctypes.POINTER(ctypes.c_char_p)),
        ("extra_poses_3x4", ctypes.POINTER(ctypes.c_float)),
        ("seed", ctypes.c_uint64),
        ("threads", ctypes.c_uint32),
        ("form", nook_form),
        ("gamma", ctypes.c_float),
        ("saturation", ctypes.c_float),
        ("time_limit_s", ctypes.c_double),
        ("progress", nook_bake_progress_fn),
        ("progress_user", ctypes.c_void_p),
    ]


class nook_bake_bent_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("character", nook_bake_character),
        ("model", ctypes.c_void_p),
        ("model_size", ctypes.c_size_t),
        ("rays", ctypes.c_uint32),
        ("auto_pose_count", ctypes.c_uint32),
        ("samples_per_clip", ctypes.c_uint32),
        ("threads", ctypes.c_uint32),
        ("seed", ctypes.c_uint64),
        ("progress", nook_bake_progress_fn),
        ("progress_user", ctypes.c_void_p),
    ]


class nook_bake_clips_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("character", nook_bake_character),
        ("model", ctypes.c_void_p),
        ("model_size", ctypes.c_size_t),
        ("clip_names", ctypes.POINTER(ctypes.c_char_p)),
        ("clip_count", ctypes.c_uint32),
        ("rays", ctypes.c_uint32),
        ("frames_per_second", ctypes.c_float),
        ("max_error", ctypes.c_float),
        ("max_bytes", ctypes.c_float),
        ("max_modes", ctypes.c_uint32),
        ("seed", ctypes.c_uint64),
        ("threads", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("progress", nook_bake_progress_fn),
        ("progress_user", ctypes.c_void_p),
    ]


nook_bake_method = ctypes.c_int32


class nook_bake_material_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("meso", ctypes.c_char_p),
        ("btf", ctypes.POINTER(ctypes.c_float)),
        ("coverage", ctypes.POINTER(ctypes.c_float)),
        ("lights", ctypes.POINTER(ctypes.c_float)),
        ("views", ctypes.POINTER(ctypes.c_float)),
        ("light_count", ctypes.c_uint32),
        ("view_count", ctypes.c_uint32),
        ("width", ctypes.c_uint32),
        ("height", ctypes.c_uint32),
        ("max_tilt_degrees", ctypes.c_float),
        ("samples", ctypes.c_uint32),
        ("bounces", ctypes.c_uint32),
        ("bounce_rays", ctypes.c_uint32),
        ("method", nook_bake_method),
        ("form", nook_form),
        ("visibility", ctypes.c_int32),
        ("rank_light", ctypes.c_uint32),
        ("rank_view", ctypes.c_uint32),
        ("rank_x", ctypes.c_uint32),
        ("rank_y", ctypes.c_uint32),
        ("votf_rank_x", ctypes.c_uint32),
        ("votf_rank_y", ctypes.c_uint32),
        ("cluster_rank_view", ctypes.c_uint32),
        ("clusters", ctypes.c_uint32),
        ("mixture", ctypes.c_uint32),
        ("view_map_side", ctypes.c_uint32),
        ("rank_threshold", ctypes.c_float),
        ("visibility_threshold", ctypes.c_float),
        ("visibility_weight", ctypes.c_float),
        ("threads", ctypes.c_uint32),
        ("seed", ctypes.c_uint64),
        ("progress", nook_bake_progress_fn),
        ("progress_user", ctypes.c_void_p),
        ("bits", ctypes.c_uint32),
        ("relief", ctypes.c_uint32),
        ("heights", ctypes.POINTER(ctypes.c_float)),
        ("neural_channels", ctypes.c_uint32),
        ("neural_steps", ctypes.c_uint32),
    ]


class nook_bake_synthesis_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("material", ctypes.c_void_p),
        ("material_size", ctypes.c_size_t),
        ("crop", ctypes.c_uint32 * 4),
        ("is_tiling", ctypes.c_uint32),
        ("side", ctypes.c_uint32),
        ("jitter", ctypes.c_float),
        ("passes", ctypes.c_uint32),
        ("seed", ctypes.c_uint64),
        ("threads", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("progress", nook_bake_progress_fn),
        ("progress_user", ctypes.c_void_p),
    ]


class nook_bake_transfer_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("normals", ctypes.POINTER(ctypes.c_float)),
        ("tangents", ctypes.POINTER(ctypes.c_float)),
        ("uvs", ctypes.POINTER(ctypes.c_float)),
        ("indices", ctypes.POINTER(ctypes.c_uint32)),
        ("vertex_count", ctypes.c_uint32),
        ("index_count", ctypes.c_uint32),
        ("lobes", ctypes.c_uint32),
        ("ray_side", ctypes.c_uint32),
        ("threads", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("progress", nook_bake_progress_fn),
        ("progress_user", ctypes.c_void_p),
        ("bounces", ctypes.c_uint32),
        ("tiles", ctypes.c_float),
        ("votf", ctypes.c_void_p),
        ("votf_size", ctypes.c_size_t),
        ("material", ctypes.c_void_p),
        ("material_size", ctypes.c_size_t),
        ("clusters", ctypes.c_uint32),
        ("form", nook_form),
    ]


class nook_scene_instance_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("level", ctypes.c_uint32),
        ("level_error", ctypes.c_float),
        ("sphere_count", ctypes.c_uint32),
        ("key_point_count", ctypes.c_uint32),
        ("link_count", ctypes.c_uint32),
        ("culled_count", ctypes.c_uint32),
        ("updated", ctypes.c_uint32),
        ("bound_centre_ws", ctypes.c_float * 3),
        ("bound_radius", ctypes.c_float),
    ]


class nook_scene_sphere(ctypes.Structure):
    _fields_ = [
        ("centre_ws", ctypes.c_float * 3),
        ("radius", ctypes.c_float),
        ("bone", ctypes.c_uint32),
        ("caster_weight", ctypes.c_float),
    ]


class nook_scene_key_point(ctypes.Structure):
    _fields_ = [
        ("position_ws", ctypes.c_float * 3),
        ("shadow", ctypes.c_float),
        ("normal_ws", ctypes.c_float * 3),
        ("added", ctypes.c_float),
        ("surface_position_ws", ctypes.c_float * 3),
        ("index", ctypes.c_uint32),
    ]


class nook_gl_memory(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("model_bytes", ctypes.c_uint64),
        ("instance_bytes", ctypes.c_uint64),
        ("lit_instance_bytes", ctypes.c_uint64),
    ]


nook_nnao_path = ctypes.c_int32
nook_nnao_sample = ctypes.c_int32


class nook_nnao_debug_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("path", nook_nnao_path),
        ("depth_sample", nook_nnao_sample),
        ("timers", ctypes.c_int32),
    ]


nook_nnao_view = ctypes.c_int32


class nook_nnao_frame_debug_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("show", nook_nnao_view),
    ]


nook_world_view = ctypes.c_int32


class nook_world_frame_debug_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("show", nook_world_view),
    ]


nook_probe_irradiance_form = ctypes.c_int32
nook_probe_specular_form = ctypes.c_int32


class nook_probe_surface(ctypes.Structure):
    _fields_ = [
        ("normal", ctypes.c_float * 3),
        ("view", ctypes.c_float * 3),
        ("tangent", ctypes.c_float * 3),
        ("alpha_x", ctypes.c_float),
        ("alpha_y", ctypes.c_float),
        ("reflectance", ctypes.c_float),
    ]


nook_probe_study_method = ctypes.c_int32
nook_probe_denominator = ctypes.c_int32


class nook_probe_fit_study_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("method", nook_probe_study_method),
        ("published_step", ctypes.c_int32),
        ("denominator", nook_probe_denominator),
        ("dice", ctypes.c_int32),
    ]


nook_bake_clip_split = ctypes.c_int32


class nook_bake_character_study_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("clip_split", nook_bake_clip_split),
        ("kernel", nook_form),
        ("fit", nook_form),
        ("calibration_pose_count", ctypes.c_uint32),
        ("calibration_poses_3x4", ctypes.POINTER(ctypes.c_float)),
    ]


class nook_bake_occluder_mesh(ctypes.Structure):
    _fields_ = [
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("indices", ctypes.POINTER(ctypes.c_uint32)),
        ("vertex_count", ctypes.c_uint32),
        ("index_count", ctypes.c_uint32),
    ]


class nook_bake_trace_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("meshes", ctypes.POINTER(nook_bake_occluder_mesh)),
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("normals", ctypes.POINTER(ctypes.c_float)),
        ("mesh_count", ctypes.c_uint32),
        ("point_count", ctypes.c_uint32),
        ("rays", ctypes.c_uint32),
        ("threads", ctypes.c_uint32),
        ("seed", ctypes.c_uint64),
        ("radius", ctypes.c_float),
        ("origin_offset", ctypes.c_float),
        ("progress", nook_bake_progress_fn),
        ("progress_user", ctypes.c_void_p),
    ]


class nook_bake_environment(ctypes.Structure):
    _fields_ = [
        ("rgb", ctypes.POINTER(ctypes.c_float)),
        ("width", ctypes.c_uint32),
        ("height", ctypes.c_uint32),
    ]


class nook_bake_lit_mesh(ctypes.Structure):
    _fields_ = [
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("indices", ctypes.POINTER(ctypes.c_uint32)),
        ("vertex_count", ctypes.c_uint32),
        ("index_count", ctypes.c_uint32),
        ("base_colour", ctypes.c_float * 3),
        ("emission", ctypes.c_float * 3),
    ]


class nook_bake_irradiance_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("meshes", ctypes.POINTER(nook_bake_lit_mesh)),
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("normals", ctypes.POINTER(ctypes.c_float)),
        ("environment", nook_bake_environment),
        ("mesh_count", ctypes.c_uint32),
        ("point_count", ctypes.c_uint32),
        ("rays", ctypes.c_uint32),
        ("threads", ctypes.c_uint32),
        ("seed", ctypes.c_uint64),
        ("max_bounces", ctypes.c_uint32),
        ("origin_offset", ctypes.c_float),
        ("progress", nook_bake_progress_fn),
        ("progress_user", ctypes.c_void_p),
    ]


class nook_transfer(ctypes.c_void_p):
    pass


class nook_transfer_light(ctypes.c_void_p):
    pass


class nook_transfer_response(ctypes.c_void_p):
    pass


class nook_transfer_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("vertex_count", ctypes.c_uint32),
        ("lobe_count", ctypes.c_uint32),
        ("sharpness", ctypes.c_float),
        ("share_bytes", ctypes.c_uint64),
        ("bounces", ctypes.c_uint32),
        ("has_holes", ctypes.c_int32),
        ("indirect_bytes", ctypes.c_uint64),
        ("form", nook_form),
        ("light_modes", ctypes.c_uint32),
        ("paper_bytes", ctypes.c_uint64),
    ]


class nook_transfer_mesh_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("vertex_count", ctypes.c_uint32),
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("normals", ctypes.POINTER(ctypes.c_float)),
        ("tangents", ctypes.POINTER(ctypes.c_float)),
        ("uvs", ctypes.POINTER(ctypes.c_float)),
    ]


nook_transfer_map_layout = ctypes.c_int32


class nook_transfer_light_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("rgb", ctypes.POINTER(ctypes.c_float)),
        ("width", ctypes.c_uint32),
        ("height", ctypes.c_uint32),
        ("layout", nook_transfer_map_layout),
        ("split_suns", ctypes.c_int32),
        ("probe", nook_probe),
        ("position_ws", ctypes.POINTER(ctypes.c_float)),
        ("direction", ctypes.POINTER(ctypes.c_float)),
        ("irradiance", ctypes.c_float * 3),
    ]


class nook_transfer_sun(ctypes.Structure):
    _fields_ = [
        ("direction", ctypes.c_float * 3),
        ("irradiance", ctypes.c_float * 3),
        ("solid_angle", ctypes.c_float),
    ]


class nook_transfer_projection_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("relative_error", ctypes.c_float),
        ("negative_share", ctypes.c_float),
    ]


class nook_transfer_response_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("material", nook_material),
        ("lobe_count", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
    ]


class nook_transfer_response_info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("lobe_count", ctypes.c_uint32),
        ("light_modes", ctypes.c_uint32),
        ("vector_floats", ctypes.c_uint32),
        ("table_bytes", ctypes.c_uint64),
        ("reflectance", ctypes.c_float * 3),
        ("reserved", ctypes.c_uint32),
    ]


class nook_transfer_vectors_desc(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("type", ctypes.c_uint32),
        ("next", ctypes.c_void_p),
        ("transfer", nook_transfer),
        ("amplitudes", ctypes.POINTER(ctypes.c_float)),
        ("lobe_count", ctypes.c_uint32),
        ("first_vertex", ctypes.c_uint32),
        ("normals", ctypes.POINTER(ctypes.c_float)),
        ("tangents", ctypes.POINTER(ctypes.c_float)),
    ]


FUNCTIONS: Dict[str, Tuple[Any, List[Any]]] = {
    "nook_last_message": (ctypes.c_char_p, []),
    "nook_result_name": (ctypes.c_char_p, [nook_result]),
    "nook_version": (ctypes.c_uint32, []),
    "nook_version_text": (ctypes.c_char_p, []),
    "nook_desc_init": (nook_result, [ctypes.c_uint32, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_uint32]),
    "nook_context_create": (nook_result, [ctypes.POINTER(nook_context_desc), ctypes.POINTER(nook_context)]),
    "nook_context_destroy": (None, [ctypes.POINTER(nook_context)]),
    "nook_probe_fit_create": (nook_result, [nook_context, ctypes.POINTER(nook_probe_fit_desc), ctypes.POINTER(nook_probe_fit)]),
    "nook_probe_fit_destroy": (None, [ctypes.POINTER(nook_probe_fit)]),
    "nook_probe_fit_add_samples": (nook_result, [nook_probe_fit, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_size_t]),
    "nook_probe_fit_merge": (nook_result, [nook_probe_fit, nook_probe_fit]),
    "nook_probe_fit_reset": (nook_result, [nook_probe_fit]),
    "nook_probe_fit_solve": (nook_result, [nook_probe_fit, ctypes.POINTER(nook_probe)]),
    "nook_probe_fit_describe": (nook_result, [nook_probe_fit, ctypes.POINTER(nook_probe_fit_info)]),
    "nook_probe_create": (nook_result, [nook_context, ctypes.POINTER(nook_probe_desc), ctypes.POINTER(nook_probe)]),
    "nook_probe_load": (nook_result, [nook_context, ctypes.c_void_p, ctypes.c_size_t, ctypes.POINTER(nook_probe)]),
    "nook_probe_destroy": (None, [ctypes.POINTER(nook_probe)]),
    "nook_probe_save": (nook_result, [nook_probe, nook_probe_packing, ctypes.c_void_p, ctypes.POINTER(ctypes.c_size_t)]),
    "nook_probe_describe": (nook_result, [nook_probe, ctypes.POINTER(nook_probe_info)]),
    "nook_probe_read_coefficients": (nook_result, [nook_probe, ctypes.c_uint32, ctypes.POINTER(ctypes.c_float), ctypes.c_uint32]),
    "nook_probe_read_lobes": (nook_result, [nook_probe, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(nook_lobe), ctypes.c_uint32]),
    "nook_probe_radiance": (nook_result, [nook_probe, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_size_t]),
    "nook_probe_irradiance": (nook_result, [nook_probe, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_size_t]),
    "nook_model_load": (nook_result, [nook_context, ctypes.c_void_p, ctypes.c_size_t, ctypes.POINTER(nook_model)]),
    "nook_model_destroy": (None, [ctypes.POINTER(nook_model)]),
    "nook_model_describe": (nook_result, [nook_model, ctypes.POINTER(nook_model_info)]),
    "nook_model_bone_name": (ctypes.c_char_p, [nook_model, ctypes.c_uint32]),
    "nook_model_describe_primitive": (nook_result, [nook_model, ctypes.c_uint32, ctypes.POINTER(nook_range)]),
    "nook_model_read": (nook_result, [nook_model, nook_model_array, ctypes.c_void_p, ctypes.c_uint32, ctypes.c_size_t]),
    "nook_scene_create": (nook_result, [nook_context, ctypes.POINTER(nook_scene_desc), ctypes.POINTER(nook_scene)]),
    "nook_scene_destroy": (None, [ctypes.POINTER(nook_scene)]),
    "nook_scene_add_instance": (nook_result, [nook_scene, nook_model, ctypes.POINTER(nook_instance_id)]),
    "nook_scene_remove_instance": (nook_result, [nook_scene, nook_instance_id]),
    "nook_scene_set_model": (nook_result, [nook_scene, nook_instance_id, nook_model]),
    "nook_scene_link": (nook_result, [nook_scene, nook_instance_id, nook_instance_id]),
    "nook_scene_unlink": (nook_result, [nook_scene, nook_instance_id, nook_instance_id]),
    "nook_scene_link_nearest": (nook_result, [nook_scene, ctypes.c_uint32, ctypes.c_float]),
    "nook_scene_set_ground": (nook_result, [nook_scene, nook_instance_id, ctypes.POINTER(ctypes.c_float)]),
    "nook_scene_add_occluder": (nook_result, [nook_scene, ctypes.POINTER(nook_occluder), ctypes.POINTER(nook_occluder_id)]),
    "nook_scene_set_occluder": (nook_result, [nook_scene, nook_occluder_id, ctypes.POINTER(nook_occluder)]),
    "nook_scene_remove_occluder": (nook_result, [nook_scene, nook_occluder_id]),
    "nook_scene_set_light": (nook_result, [nook_scene, nook_instance_id, ctypes.POINTER(nook_lobe), ctypes.c_uint32]),
    "nook_scene_set_camera": (nook_result, [nook_scene, ctypes.POINTER(ctypes.c_float)]),
    "nook_scene_update": (nook_result, [nook_scene]),
    "nook_scene_read": (nook_result, [nook_scene, nook_instance_id, nook_channel, nook_format, ctypes.c_void_p, ctypes.c_uint32, ctypes.c_size_t]),
    "nook_scene_describe": (nook_result, [nook_scene, ctypes.POINTER(nook_scene_info)]),
    "nook_scene_set_pose": (nook_result, [nook_scene, nook_instance_id, ctypes.POINTER(nook_pose_desc)]),
    "nook_model_convert_pose": (nook_result, [nook_model, ctypes.POINTER(nook_pose_desc), ctypes.POINTER(ctypes.c_float), ctypes.c_uint32]),
    "nook_model_map_bones": (nook_result, [nook_model, ctypes.POINTER(nook_bone_map_desc), ctypes.POINTER(ctypes.c_int32), ctypes.c_uint32, ctypes.POINTER(ctypes.c_uint32)]),
    "nook_model_describe_skin": (nook_result, [nook_model, ctypes.c_uint32, ctypes.POINTER(nook_skin_info)]),
    "nook_model_describe_check_vertex": (nook_result, [nook_model, ctypes.c_uint32, ctypes.POINTER(nook_check_vertex_info)]),
    "nook_model_check_pose": (nook_result, [nook_model, ctypes.POINTER(nook_pose_desc), ctypes.POINTER(nook_pose_check_desc), ctypes.POINTER(nook_pose_check_info)]),
    "nook_model_match_vertices": (nook_result, [nook_model, ctypes.POINTER(nook_vertex_match_desc), ctypes.POINTER(ctypes.c_uint32), ctypes.POINTER(nook_vertex_match_info)]),
    "nook_model_remap": (nook_result, [nook_model, ctypes.POINTER(ctypes.c_uint32), ctypes.c_uint32, ctypes.POINTER(nook_model)]),
    "nook_material_load": (nook_result, [nook_context, ctypes.c_void_p, ctypes.c_size_t, ctypes.POINTER(nook_material_desc), ctypes.POINTER(nook_material)]),
    "nook_material_destroy": (None, [ctypes.POINTER(nook_material)]),
    "nook_material_describe": (nook_result, [nook_material, ctypes.POINTER(nook_material_info)]),
    "nook_material_evaluate": (nook_result, [nook_material, ctypes.POINTER(nook_material_pixel), ctypes.c_uint32, ctypes.c_uint32, ctypes.POINTER(nook_material_value)]),
    "nook_bake_desc_init": (nook_result, [ctypes.c_uint32, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_uint32]),
    "nook_bake_last_message": (ctypes.c_char_p, []),
    "nook_bake_start": (nook_result, [ctypes.c_void_p, ctypes.POINTER(nook_bake_job)]),
    "nook_bake_job_poll": (nook_result, [nook_bake_job, ctypes.POINTER(nook_bake_progress)]),
    "nook_bake_job_cancel": (nook_result, [nook_bake_job]),
    "nook_bake_job_wait": (nook_result, [nook_bake_job]),
    "nook_bake_job_file": (nook_result, [nook_bake_job, ctypes.POINTER(ctypes.c_void_p), ctypes.POINTER(ctypes.c_size_t)]),
    "nook_bake_job_report": (nook_result, [nook_bake_job, ctypes.POINTER(ctypes.c_char_p)]),
    "nook_bake_job_destroy": (None, [ctypes.POINTER(nook_bake_job)]),
    "nook_bake_character_create": (nook_result, [ctypes.POINTER(nook_bake_source_desc), ctypes.POINTER(nook_bake_character)]),
    "nook_bake_character_destroy": (None, [ctypes.POINTER(nook_bake_character)]),
    "nook_bake_character_describe": (nook_result, [nook_bake_character, ctypes.POINTER(nook_bake_character_info)]),
    "nook_bake_character_name": (ctypes.c_char_p, [nook_bake_character, nook_bake_name, ctypes.c_uint32]),
    "nook_bake_character_read": (nook_result, [nook_bake_character, nook_bake_array, ctypes.c_void_p, ctypes.c_uint32, ctypes.c_size_t]),
    "nook_bake_character_clip_duration": (nook_result, [nook_bake_character, ctypes.c_uint32, ctypes.POINTER(ctypes.c_float)]),
    "nook_bake_character_sample_clip": (nook_result, [nook_bake_character, ctypes.c_uint32, ctypes.c_float, ctypes.POINTER(ctypes.c_float), ctypes.c_uint32]),
    "nook_bake_character_auto_poses": (nook_result, [nook_bake_character, ctypes.c_uint64, ctypes.c_uint32, ctypes.POINTER(ctypes.c_float), ctypes.c_uint32]),
    "nook_bake_character_skin": (nook_result, [nook_bake_character, ctypes.POINTER(ctypes.c_float), ctypes.c_uint32, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_uint32]),
    "nook_bake_key": (nook_result, [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_size_t]),
    "nook_scene_record_pose": (nook_result, [nook_scene, nook_instance_id, ctypes.c_void_p, ctypes.POINTER(ctypes.c_size_t)]),
    "nook_model_recipe": (nook_result, [nook_model, ctypes.POINTER(ctypes.c_char_p)]),
    "nook_scene_describe_instance": (nook_result, [nook_scene, nook_instance_id, ctypes.POINTER(nook_scene_instance_info)]),
    "nook_scene_read_spheres": (nook_result, [nook_scene, nook_instance_id, ctypes.POINTER(nook_scene_sphere), ctypes.POINTER(ctypes.c_uint32)]),
    "nook_scene_read_key_points": (nook_result, [nook_scene, nook_instance_id, ctypes.POINTER(nook_scene_key_point), ctypes.POINTER(ctypes.c_uint32)]),
    "nook_scene_read_links": (nook_result, [nook_scene, nook_instance_id, ctypes.POINTER(nook_instance_id), ctypes.POINTER(ctypes.c_uint32)]),
    "nook_scene_set_terms": (nook_result, [nook_scene, ctypes.c_uint32]),
    "nook_model_resample": (nook_result, [nook_model, ctypes.POINTER(nook_vertex_match_desc), ctypes.POINTER(nook_model)]),
    "nook_model_match_mesh": (nook_result, [nook_model, ctypes.POINTER(nook_vertex_match_desc), ctypes.POINTER(ctypes.c_uint32), ctypes.c_size_t, ctypes.POINTER(ctypes.c_uint32), ctypes.POINTER(nook_vertex_match_info)]),
    "nook_model_evaluate_poses": (nook_result, [nook_model, ctypes.POINTER(nook_scene_desc), ctypes.POINTER(nook_pose_desc), ctypes.c_uint32, ctypes.c_size_t, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_size_t]),
    "nook_sg_radiance": (nook_result, [ctypes.POINTER(nook_lobe), ctypes.c_uint32, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_size_t]),
    "nook_sg_irradiance": (nook_result, [ctypes.POINTER(nook_lobe), ctypes.c_uint32, nook_probe_irradiance_form, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_size_t]),
    "nook_sg_specular": (nook_result, [ctypes.POINTER(nook_lobe), ctypes.c_uint32, nook_probe_specular_form, ctypes.POINTER(nook_probe_surface), ctypes.POINTER(ctypes.c_float), ctypes.c_size_t]),
    "nook_probe_read_gloss": (nook_result, [nook_probe, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(nook_lobe), ctypes.c_uint32]),
    "nook_sg_integral": (nook_result, [ctypes.POINTER(nook_lobe), ctypes.POINTER(ctypes.c_float)]),
    "nook_sg_product": (nook_result, [ctypes.POINTER(nook_lobe), ctypes.POINTER(nook_lobe), ctypes.POINTER(nook_lobe)]),
    "nook_sg_convolve": (nook_result, [ctypes.POINTER(nook_lobe), ctypes.POINTER(nook_lobe), ctypes.POINTER(nook_lobe)]),
    "nook_sg_rotate": (nook_result, [ctypes.POINTER(nook_lobe), ctypes.c_uint32, ctypes.POINTER(ctypes.c_float)]),
    "nook_sg_to_sh": (nook_result, [ctypes.POINTER(nook_lobe), ctypes.c_uint32, ctypes.c_uint32, ctypes.POINTER(ctypes.c_float)]),
    "nook_sh_radiance": (nook_result, [ctypes.POINTER(ctypes.c_float), ctypes.c_uint32, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_size_t]),
    "nook_sh_irradiance": (nook_result, [ctypes.POINTER(ctypes.c_float), ctypes.c_uint32, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_size_t]),
    "nook_sh_to_zh3": (nook_result, [ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float)]),
    "nook_probe_fit_seed": (nook_result, [nook_probe_fit, nook_probe_fit]),
    "nook_bake_character_single_joint_poses": (nook_result, [nook_bake_character, ctypes.c_uint32, ctypes.c_float, ctypes.POINTER(ctypes.c_uint32), ctypes.POINTER(ctypes.c_float), ctypes.c_uint32]),
    "nook_bake_trace_ao": (nook_result, [ctypes.POINTER(nook_bake_trace_desc), ctypes.POINTER(ctypes.c_float), ctypes.c_uint32]),
    "nook_bake_trace_irradiance": (nook_result, [ctypes.POINTER(nook_bake_irradiance_desc), ctypes.POINTER(ctypes.c_float), ctypes.c_uint32]),
    "nook_transfer_load": (nook_result, [nook_context, ctypes.c_void_p, ctypes.c_size_t, ctypes.POINTER(nook_transfer)]),
    "nook_transfer_destroy": (None, [ctypes.POINTER(nook_transfer)]),
    "nook_transfer_describe": (nook_result, [nook_transfer, ctypes.POINTER(nook_transfer_info)]),
    "nook_transfer_read_frames": (nook_result, [nook_transfer, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.c_uint32]),
    "nook_transfer_check": (nook_result, [nook_transfer, ctypes.POINTER(nook_transfer_mesh_desc), nook_material]),
    "nook_transfer_light_create": (nook_result, [nook_context, ctypes.POINTER(nook_transfer_light_desc), ctypes.POINTER(nook_transfer_light)]),
    "nook_transfer_light_destroy": (None, [ctypes.POINTER(nook_transfer_light)]),
    "nook_transfer_light_read_suns": (nook_result, [nook_transfer_light, ctypes.POINTER(nook_transfer_sun), ctypes.POINTER(ctypes.c_uint32)]),
    "nook_transfer_light_project": (nook_result, [nook_transfer_light, ctypes.c_uint32, ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_float), ctypes.POINTER(nook_transfer_projection_info)]),
    "nook_transfer_response_create": (nook_result, [nook_context, ctypes.POINTER(nook_transfer_response_desc), ctypes.POINTER(nook_transfer_response)]),
    "nook_transfer_response_destroy": (None, [ctypes.POINTER(nook_transfer_response)]),
    "nook_transfer_response_describe": (nook_result, [nook_transfer_response, ctypes.POINTER(nook_transfer_response_info)]),
    "nook_transfer_read_vectors": (nook_result, [nook_transfer_response, ctypes.POINTER(nook_transfer_vectors_desc), ctypes.POINTER(ctypes.c_float), ctypes.c_uint32, ctypes.c_uint32]),
    "nook_transfer_shade": (nook_result, [nook_material, ctypes.POINTER(nook_material_pixel), ctypes.POINTER(ctypes.c_float), ctypes.c_uint32, ctypes.c_uint32, ctypes.POINTER(ctypes.c_float)]),
}
