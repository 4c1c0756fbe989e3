in vec3 albedo, ambient, direct;
in float ao;
out vec3 colour;
