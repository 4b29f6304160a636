// The wide light on a face of a cube map.
uniform int face;
out vec4 colour;

void main() {
    vec2 p = 2.0 * gl_FragCoord.xy / size - 1.0;
    vec3 d = vec3(face == 0 ? 1.0 : -1.0, -p.y, face == 0 ? -p.x : p.x);
    if (face == 2 || face == 3) {
        d = vec3(p.x, face == 2 ? 1.0 : -1.0, face == 2 ? p.y : -p.y);
    } else if (face > 3) {
        d = vec3(face == 4 ? p.x : -p.x, -p.y, face == 4 ? 1.0 : -1.0);
    }
    colour = vec4(wide_light(normalize(d)), 1.0);
}
