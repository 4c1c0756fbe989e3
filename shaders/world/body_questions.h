// What bodies.frag counts for BodyWatch. C++ and GLSL both include this file.
#ifndef NOOK_WORLD_BODY_QUESTIONS_H
#define NOOK_WORLD_BODY_QUESTIONS_H

// The number of bodies that a frame is compared with.
#define NOOK_WATCHED_BODIES 16

// SURFACE: pixels with a surface. MASKED: surfaces that may belong to a body. With a mask, only surfaces in
// the mask may. FOUND: surfaces of MASKED that lie in a body. FOUND_OTHERWISE: surfaces of MASKED that would
// lie in a body without a certain mistake of the host. SHOW_THROUGH: pixels that show what is behind a body.
// FAR_ENOUGH: surfaces whose distance from the camera is not small beside the size of the bodies. LIT:
// surfaces that face the light.
#define NOOK_BODIES_SURFACE 0
#define NOOK_BODIES_MASKED 1
#define NOOK_BODIES_FOUND 2
#define NOOK_BODIES_FOUND_OTHERWISE 3
#define NOOK_BODIES_SHOW_THROUGH 4
#define NOOK_BODIES_FAR_ENOUGH 5
#define NOOK_BODIES_LIT 6
#define NOOK_BODIES_QUESTIONS 7

#endif
