// Many drawn normals, one a pixel, and what is to be said of each.
layout(location = 0) out vec4 drawn_out; // facing, density, angle from the mean normal, how far vndf_pdf is off
layout(location = 1) out vec4 light_out; // G2/G1 of the reflected direction, faults, the normal's x and y

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    vec2 u = (vec2(pixel) + random_at(uvec3(pixel, 11u)).xy) / size;
    vndf_view view = vndf_view_from(surface_here(), incident);
    vndf_sampled drawn = vndf_sample(view, u.x, u.y);
    float facing = dot(incident, drawn.wm);
    float pdf = vndf_pdf(view, drawn.wm);
    vec3 wo = 2.0 * facing * drawn.wm - incident;
    bool good = facing > 0.0 && drawn.wm.z >= 0.0 && drawn.pdf > 0.0 && drawn.pdf < 1e30;
    drawn_out = vec4(facing, drawn.pdf, acos(clamp(drawn.wm.z, 0.0, 1.0)), abs(pdf / drawn.pdf - 1.0));
    light_out = vec4(light_kept(view, wo), good ? 0.0 : 1.0, drawn.wm.xy);
}
