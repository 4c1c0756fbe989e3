extern nook_nnao pass;
extern float earlier_view_times_inverse_of_this_view[12];
extern int camera_was_cut;
