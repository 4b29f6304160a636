// What all shaders of the page begin with, after the kernel.

const float PI = 3.14159265;

uniform int distribution; // the first number of a table, VNDF_GGX or VNDF_BECKMANN
uniform vec2 alpha;
uniform float turn; // of the axes, radians
uniform vec3 incident;
uniform vec2 size; // of the target, pixels
uniform float rim; // of a disc: sin(theta/2) at its edge

vndf_surface surface_here() {
    float c = cos(turn);
    float s = sin(turn);
    return vndf_surface(distribution, c * alpha.x, -s * alpha.y, s * alpha.x, c * alpha.y, 0.0, 0.0);
}

// Three numbers in [0, 1) for three integers (Jarzynski & Olano 2020).
vec3 random_at(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3(v >> 8u) / 16777216.0;
}

// A normal on a disc of radius 1, seen from above; equal areas are equal solid angles.
vec3 normal_from_disc(vec2 p) {
    float s2 = dot(p, p) * rim * rim;
    return vec3(p * rim * 2.0 * sqrt(max(1.0 - s2, 0.0)), max(1.0 - 2.0 * s2, 0.0));
}

// G2/G1: what the surface does not shadow of the light from wo. It is vndf_g2 over vndf_g1, but the view knows the
// area seen from wi, hence 1 + Lambda(wi).
float light_kept(vndf_view view, vec3 wo) {
    float own = vndf_area(view) / view.wi.z;
    return wo.z > 0.0 ? own / (own + vndf_lambda(surface_here(), wo)) : 0.0;
}
