// What an engine that shades in one pass makes of a surface, from the tables of `vndf bake`, and the same by samples:
// a floor under a rectangle that shines, and a sphere in the wide light. Fresnel's term is Schlick's in all of them, so
// that pictures differ by the tables alone.

uniform bool is_floor, in_one_pass;
uniform highp sampler2D ltc, splits, taps; // inverse matrices; E of F = 1, its Fresnel part, scale, bias; prefilter
uniform highp samplerCube wide;            // the wide light, with mip levels
uniform float table_size, roughness;
uniform highp sampler2D before;
uniform bool first;
uniform vec2 pixel_step, normal_step, lamp_step;
out vec4 sum;

const vec3 CORNER = vec3(-1.1, 1.6, 0.25); // of the rectangle, which stands upright; z is up on the floor
const vec2 SIDES = vec2(2.2, 1.1);         // along x and z
const vec3 SHINE = vec3(4.0, 3.8, 3.4);

vec3 f0() {
    return material >= 3 ? vec3(0.04) : front_colour();
}

vec3 schlick(float c) {
    return f0() + (1.0 - f0()) * pow(1.0 - clamp(c, 0.0, 1.0), 5.0);
}

// ---- one pass ----

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
    return SHINE * rectangle(corner) * (f0() * norm.x + (1.0 - f0()) * norm.y);
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
    return comes * (f0() * split.x + split.y);
}

// ---- by samples ----

// The distance at which a ray meets the rectangle, 0: nowhere.
float rectangle_at(vec3 from, vec3 d) {
    float t = (CORNER.y - from.y) / d.y;
    vec2 p = (from + t * d - CORNER).xz / SIDES;
    return t > 0.0 && all(greaterThan(p, vec2(0.0))) && all(lessThan(p, vec2(1.0))) ? t : 0.0;
}

// One sample of a drawn normal or of the rectangle, each weighted by the densities of both.
vec3 of_area(frame f, vec3 at, vndf_view view, bool from_light, vec2 u) {
    vec3 to = normalize(CORNER + vec3(u.x * SIDES.x, 0.0, u.y * SIDES.y) - at);
    vec3 wo = local(f, to);
    vec3 wm = normalize(view.wi + wo);
    if (!from_light) {
        wm = vndf_sample(view, u.x, u.y).wm;
        wo = 2.0 * dot(view.wi, wm) * wm - view.wi;
        to = world(f, wo);
    }
    float t = rectangle_at(at, to);
    if (wo.z <= 0.0 || t <= 0.0) {
        return vec3(0.0);
    }
    float facing = dot(view.wi, wm);
    float drawn = vndf_pdf(view, wm) / (4.0 * facing);
    float light = t * t / (abs(to.y) * SIDES.x * SIDES.y);
    float value = from_light ? vndf_visible(view, wm) / (4.0 * facing) : drawn;
    return SHINE * schlick(facing) * light_kept(view, wo) * value / (drawn + light);
}

vec3 of_environment(frame f, vndf_view view, vec2 u) {
    vec3 wm = vndf_sample(view, u.x, u.y).wm;
    vec3 wo = 2.0 * dot(view.wi, wm) * wm - view.wi;
    return wo.z > 0.0 ? wide_light(world(f, wo)) * schlick(dot(view.wi, wm)) * light_kept(view, wo) : vec3(0.0);
}

// ---- the scenes ----

frame frame_of(vec3 z, vec3 wi) {
    vec3 x = normalize(wi - dot(wi, z) * z + vec3(1e-6, 0.0, 0.0));
    return frame(x, cross(z, x), z);
}

vec3 shaded(vec3 at, vec3 normal, vec3 d, vec2 u_normal, vec2 u_lamp) {
    frame f = frame_of(normal, -d);
    vec3 wi = local(f, -d);
    wi = normalize(vec3(wi.xy, max(wi.z, 2e-3)));
    if (in_one_pass) {
        return is_floor ? area_in_one_pass(f, at, wi) : environment_in_one_pass(f, wi);
    }
    vndf_view view = vndf_view_of(surface_here(), wi);
    return is_floor ? of_area(f, at, view, false, u_normal) + of_area(f, at, view, true, u_lamp)
                    : of_environment(f, view, u_normal);
}

vec3 seen(vec3 eye, vec3 d, vec2 u_normal, vec2 u_lamp) {
    if (is_floor) {
        float t = rectangle_at(eye, d);
        float down = d.z < 0.0 ? -eye.z / d.z : 0.0;
        if (t > 0.0 || down <= 0.0) {
            return t > 0.0 ? SHINE : vec3(0.0);
        }
        return shaded(vec3((eye + down * d).xy, 0.0), vec3(0.0, 0.0, 1.0), d, u_normal, u_lamp);
    }
    float b = dot(eye, d);
    float root = b * b - dot(eye, eye) + 1.0;
    if (root <= 0.0) {
        return vec3(0.0);
    }
    vec3 at = normalize(eye - d * (b + sqrt(root)));
    return shaded(at, at, d, u_normal, u_lamp);
}

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    vec3 a = random_at(uvec3(pixel, 1u));
    vec3 b = random_at(uvec3(pixel, 2u));
    vec2 jitter = fract(a.xy + pixel_step) - 0.5;
    vec2 p = (2.0 * (gl_FragCoord.xy + jitter) - size) / size.y;
    vec3 up = is_floor ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0);
    vec3 eye = is_floor ? vec3(0.0, -2.6, 1.3) : vec3(0.0, 1.1, 4.9);
    vec3 ahead = normalize((is_floor ? vec3(0.0, 0.7, 0.3) : vec3(0.0)) - eye);
    vec3 right = normalize(cross(ahead, up));
    float wide_angle = is_floor ? 0.5 : 0.215;
    vec3 d = normalize(ahead + wide_angle * (p.x * right + p.y * cross(right, ahead)));
    sum = vec4(seen(eye, d, fract(vec2(a.z, b.x) + normal_step), fract(b.yz + lamp_step)), 1.0);
    if (!first) {
        sum += texelFetch(before, ivec2(gl_FragCoord.xy), 0);
    }
}
