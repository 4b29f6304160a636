// Normals that vndf_sample draws, one a point.
uniform float width;
uniform int seed;

void main() {
    vec3 u = random_at(uvec3(gl_VertexID, seed, 7));
    vndf_sampled drawn = vndf_sample(vndf_view_of(surface_here(), incident), u.x, u.y);
    vec2 p = disc_from_normal(drawn.wm);
    gl_Position = vec4(dot(p, p) > 1.0 ? vec2(9.0) : p, 0.0, 1.0);
    gl_PointSize = width;
}
