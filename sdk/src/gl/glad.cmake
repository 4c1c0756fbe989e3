# nook_generate_glad(directory): writes glad's OpenGL header and loader below the directory at build time.
find_program(GLAD_EXECUTABLE glad REQUIRED)

function(nook_generate_glad directory)
  # With --reproducible, glad uses the specification in its package. Otherwise it would download the specification.
  add_custom_command(
    OUTPUT ${directory}/src/gl.c ${directory}/include/glad/gl.h ${directory}/include/KHR/khrplatform.h
    COMMAND ${GLAD_EXECUTABLE} --reproducible --quiet --api gl:core=4.6
            --extensions GL_KHR_debug,GL_ARB_clip_control --out-path ${directory} c --mx
    COMMENT "Generating the OpenGL header with glad"
    VERBATIM)
endfunction()
