// What an engine that shades in one pass makes of a surface, from the tables of `vndf bake`: a floor under a rectangle
// that shines, and a sphere in the wide light. Fresnel's term is Schlick's, as in the same by samples, so that pictures
// differ by the tables alone.

uniform highp sampler2D ltc, splits, taps; // inverse matrices; E of F = 1, its Fresnel part, scale, bias; prefilter
uniform highp samplerCube wide;            // the wide light, with mip levels
uniform float table_size, roughness;

// A part of the integral of the cosine over a polygon: an edge between these directions.
float edge(vec3 a, vec3 b) {
    vec3 from = normalize(a);
    vec3 to = normalize(b);
    float c = clamp(dot(from, to), -0.99999, 0.99999);
    return (from.x * to.y - from.y * to.x) * acos(c) / sqrt(1.0 - c * c);
}

// The part of a cosine's light that comes from the rectangle with these corners, of which what is below the horizon is
// cut off.
float rectangle(vec3 corner[4]) {
    float all = 0.0;
    vec3 leaves = vec3(0.0);
    vec3 enters = vec3(0.0);
    bool is_cut = false;
    for (int i = 0; i < 4; i += 1) {
        vec3 a = corner[i];
        vec3 b = corner[(i + 1) % 4];
        vec3 meets = mix(a, b, clamp(a.z / (a.z - b.z), 0.0, 1.0));
        if (a.z > 0.0 && b.z <= 0.0) {
            leaves = meets;
            is_cut = true;
        } else if (a.z <= 0.0 && b.z > 0.0) {
            enters = meets;
        }
        if (a.z > 0.0 || b.z > 0.0) {
            all += edge(a.z > 0.0 ? a : meets, b.z > 0.0 ? b : meets);
        }
    }
    if (is_cut) {
        all += edge(leaves, enters);
    }
    return abs(all) / (2.0 * PI);
}

vec3 area_in_one_pass(frame f, vec3 at, vec3 wi) {
    vec2 place = (vec2(roughness, sqrt(1.0 - wi.z)) * (table_size - 1.0) + 0.5) / table_size;
    vec4 m = texture(ltc, place);
    vec2 norm = texture(splits, place).xy;
    mat3 inverse = mat3(m.x, 0.0, m.y, 0.0, 1.0, 0.0, m.z, 0.0, m.w);
    vec3 corner[4];
    for (int i = 0; i < 4; i += 1) {
        vec2 side = vec2(i == 1 || i == 2 ? 1.0 : 0.0, i >= 2 ? 1.0 : 0.0) * SIDES;
        corner[i] = inverse * local(f, CORNER + vec3(side.x, 0.0, side.y) - at);
    }
    return shine * rectangle(corner) * (front_colour() * norm.x + (1.0 - front_colour()) * norm.y);
}

// Taps of two neighbours among the roughnesses, about the mirrored direction.
vec3 environment_in_one_pass(frame f, vec3 wi) {
    vec3 z = world(f, vec3(-wi.xy, wi.z));
    vec3 x = normalize(cross(abs(z.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), z));
    frame about = frame(x, cross(z, x), z);
    ivec2 count = textureSize(taps, 0);
    float level = clamp(roughness * float(count.y) - 1.0, 0.0, float(count.y) - 1.001);
    float texels = log2(float(textureSize(wide, 0).x));
    vec3 comes = vec3(0.0);
    for (int i = 0; i < 2 * count.x; i += 1) {
        int row = int(level) + i / count.x;
        vec4 tap = texelFetch(taps, ivec2(i % count.x, row), 0);
        vec3 to = world(about, vec3(tap.xy, sqrt(max(1.0 - dot(tap.xy, tap.xy), 0.0))));
        float part = i < count.x ? 1.0 - fract(level) : fract(level);
        comes += part * tap.z * textureLod(wide, to, max(texels + tap.w, 0.0)).rgb;
    }
    vec2 split = texture(splits, vec2(wi.z, roughness)).zw;
    return comes * (front_colour() * split.x + split.y);
}

vec3 shaded(vec3 at, vec3 normal, vec3 to_eye, vec2 u_normal, vec2 u_lamp, vec2 u_base) {
    vec3 x = normalize(to_eye - dot(to_eye, normal) * normal + vec3(1e-6, 0.0, 0.0));
    frame f = frame(x, cross(normal, x), normal);
    vec3 wi = local(f, to_eye);
    wi = normalize(vec3(wi.xy, max(wi.z, 1e-3)));
    return is_floor ? area_in_one_pass(f, at, wi) : environment_in_one_pass(f, wi);
}
