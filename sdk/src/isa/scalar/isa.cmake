# The scalar kernels can be built for every target.
set(isa_built ON)
