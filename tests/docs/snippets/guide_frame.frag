in vec3 albedo, ambient, direct;
uniform sampler2D world_texture;
flat in ivec2 pixel;
out vec3 colour;
