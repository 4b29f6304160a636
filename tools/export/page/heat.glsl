// The density with which vndf_sample draws normals for one incident direction, on the disc.
uniform float top, decades; // the density that has the last colour, and how far below it the first one is
uniform vec3 stops[6];      // colours
out vec4 colour;

vec3 ramp(float place) {
    float at = 5.0 * clamp(place, 0.0, 1.0);
    vec3 mixed = stops[0];
    for (int i = 0; i < 5; i += 1) {
        mixed = mix(mixed, stops[i + 1], clamp(at - float(i), 0.0, 1.0));
    }
    return mixed;
}

void main() {
    vec2 p = (2.0 * gl_FragCoord.xy - size) / size;
    float edge = clamp((1.0 - length(p)) * 0.5 * size.x + 0.5, 0.0, 1.0);
    float density = 0.0;
    if (edge > 0.0) {
        density = vndf_pdf(vndf_view_from(surface_here(), incident), normal_from_disc(p));
    }
    vec3 shade = ramp(1.0 + log(max(density, 1e-30) / top) / (decades * log(10.0)));
    colour = vec4(shade * edge, edge);
}
