// A sphere that reflects once: visible normals are drawn with vndf_sample, and the lamp with vndf_visible; each kind
// of sample is weighted by the densities of both (Veach & Guibas 1995), for which vndf_pdf is needed.

// ---- what lights it, y up: a wide part, and a lamp that is a cap of directions ----

uniform int light;   // 0 sky, 1 studio, 2 lamp in the dark, 3 white room
uniform vec4 lamp;   // its axis, and the cosine at its edge
uniform vec3 shine;  // its radiance
uniform float around; // by which the light is turned about y, radians

vec3 turned(vec3 d) {
    float c = cos(around);
    float s = sin(around);
    return vec3(c * d.x - s * d.z, d.y, s * d.x + c * d.z);
}

// A board of half size `half_size`, upright at distance 1 in the direction `to`.
float board(vec3 d, vec3 to, vec2 half_size) {
    vec3 right = normalize(cross(vec3(0.0, 1.0, 0.0), to));
    float facing = dot(d, to);
    vec2 p = vec2(dot(d, right), dot(d, cross(to, right))) / max(facing, 1e-4);
    vec2 inside = smoothstep(vec2(0.0), vec2(0.03), half_size - abs(p));
    return facing > 0.0 ? inside.x * inside.y : 0.0;
}

// Squares of a floor, that fade with the distance.
vec3 floor_at(vec3 d, vec3 dark, vec3 bright, vec3 far) {
    vec2 p = d.xz * (1.4 / max(-d.y, 1e-3));
    vec2 square = floor(p);
    float odd = mod(square.x + square.y, 2.0);
    return mix(far, mix(dark, bright, odd), exp(-0.13 * length(p)));
}

vec3 sky(vec3 d) {
    vec3 horizon = vec3(0.62, 0.76, 0.92);
    if (d.y < 0.0) {
        return floor_at(d, vec3(0.10, 0.09, 0.08), vec3(0.52, 0.48, 0.43), vec3(0.42, 0.45, 0.48));
    }
    return mix(horizon, vec3(0.07, 0.22, 0.62), pow(d.y, 0.6));
}

vec3 studio(vec3 d) {
    vec3 wall = mix(vec3(0.10, 0.105, 0.12), vec3(0.03, 0.03, 0.04), smoothstep(-0.1, 0.9, d.y));
    if (d.y < 0.0) {
        wall = floor_at(d, vec3(0.07), vec3(0.20), vec3(0.10, 0.105, 0.12));
    }
    float left = board(d, normalize(vec3(-0.85, 0.45, 0.35)), vec2(0.42, 0.62));
    float right = board(d, normalize(vec3(0.95, 0.1, 0.1)), vec2(0.14, 0.9));
    float above = board(d, normalize(vec3(0.12, 0.93, -0.3)), vec2(0.7, 0.16));
    return wall + left * vec3(3.0, 2.8, 2.6) + right * vec3(2.0, 2.4, 3.0) + above * vec3(2.0);
}

// Without the lamp.
vec3 wide_light(vec3 direction) {
    vec3 d = turned(direction);
    if (light == 0) {
        return sky(d);
    }
    if (light == 1) {
        return studio(d);
    }
    if (light == 3) {
        return vec3(1.0);
    }
    return mix(vec3(0.02), vec3(0.06, 0.065, 0.08), smoothstep(-0.6, 0.9, d.y));
}

bool hits_lamp(vec3 d) {
    return dot(d, lamp.xyz) > lamp.w;
}

// Per steradian.
float lamp_density() {
    return 1.0 / (2.0 * PI * (1.0 - lamp.w));
}

vec3 lamp_direction(vec2 u) {
    float z = mix(lamp.w, 1.0, u.x);
    float r = sqrt(max(1.0 - z * z, 0.0));
    vec3 side = normalize(cross(lamp.xyz, abs(lamp.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    return r * cos(2.0 * PI * u.y) * side + r * sin(2.0 * PI * u.y) * cross(lamp.xyz, side) + z * lamp.xyz;
}

// ---- the sphere ----

uniform highp sampler2D before; // the sums of the samples so far
uniform bool first;
uniform vec2 pixel_step, normal_step, lamp_step, base_step; // from one sample to the next
uniform int material; // 0 gold, 1 copper, 2 silver, 3 red plastic, 4 black plastic, 5 glass
out vec4 sum;

const float ETA = 1.5; // of plastic and glass

// What a boundary reflects at the cosine c, where n is the index on this side over that beyond.
float fresnel(float c, float n) {
    float below = 1.0 - n * n * (1.0 - c * c);
    float t = sqrt(max(below, 0.0));
    vec2 r = vec2(n * c - t, c - n * t) / vec2(n * c + t, c + n * t);
    return below > 0.0 ? 0.5 * dot(r, r) : 1.0;
}

// The mirror's colour at the cosine c.
vec3 mirror(float c) {
    float up = 1.0 - clamp(c, 0.0, 1.0);
    float power = up * up * up * up * up;
    if (material >= 3) {
        return vec3(fresnel(c, 1.0 / ETA));
    }
    vec3 front = vec3(0.972, 0.96, 0.915);
    front = material == 0 ? vec3(1.022, 0.782, 0.344) : front;
    front = material == 1 ? vec3(0.955, 0.638, 0.538) : front;
    return front + (vec3(1.0) - front) * power;
}

// Of a plastic, below its mirror.
vec3 base_colour() {
    return material == 3 ? vec3(0.52, 0.03, 0.025) : vec3(0.012);
}

// A direction in the frame of the sphere's point: its normal is z, and x runs around the sphere.
struct frame {
    vec3 x, y, z;
};

vec3 local(frame f, vec3 w) {
    return vec3(dot(w, f.x), dot(w, f.y), dot(w, f.z));
}

vec3 world(frame f, vec3 w) {
    return w.x * f.x + w.y * f.y + w.z * f.z;
}

// The light of one sample through the mirror: of a drawn normal, or of the lamp.
vec3 mirrored(frame f, vndf_view view, bool from_lamp, vec2 u) {
    vec3 to = from_lamp ? lamp_direction(u) : vec3(0.0);
    vec3 wo = local(f, to);
    vec3 wm = normalize(view.wi + wo);
    if (!from_lamp) {
        wm = vndf_sample(view, u.x, u.y).wm;
        wo = 2.0 * dot(view.wi, wm) * wm - view.wi;
        to = world(f, wo);
    }
    if (wo.z <= 0.0) {
        return vec3(0.0);
    }
    bool hits = from_lamp || hits_lamp(to);
    float facing = dot(view.wi, wm);
    vec3 comes = from_lamp ? vec3(0.0) : wide_light(to);
    if (hits) {
        float density = vndf_pdf(view, wm) / (4.0 * facing);
        float value = from_lamp ? vndf_visible(view, wm) / (4.0 * facing) : density;
        comes += shine * (value / (density + lamp_density()));
    }
    return comes * mirror(facing) * light_kept(view, wo);
}

// The light of one sample through a ball of glass, which is polished where the light comes in.
vec3 through_glass(frame f, vndf_view view, vec2 u) {
    vec3 wm = vndf_sample(view, u.x, u.y).wm;
    vec3 wo = refract(-view.wi, wm, 1.0 / ETA);
    vec3 d = world(f, wo);
    vec3 normal = normalize(f.z - 2.0 * dot(f.z, d) * d); // where d meets the ball from within
    vec3 to = refract(d, -normal, ETA);
    float passes = (1.0 - fresnel(dot(view.wi, wm), 1.0 / ETA)) * (1.0 - fresnel(dot(d, normal), ETA));
    if (wo.z >= 0.0 || passes <= 0.0) {
        return vec3(0.0);
    }
    vec3 comes = wide_light(to) + (hits_lamp(to) ? shine : vec3(0.0));
    return comes * passes * vndf_g1(surface_here(), vec3(wo.xy, -wo.z));
}

// One sample of the lamp on the base of a plastic.
vec3 lamp_on_base(frame f, vec3 wi, vec2 u) {
    vec3 wo = local(f, lamp_direction(u));
    vec3 passes = (vec3(1.0) - mirror(wi.z)) * (vec3(1.0) - mirror(wo.z)) * base_colour() / PI;
    return shine * passes * max(wo.z, 0.0) / lamp_density();
}

// One sample of the wide light on the base of a plastic.
vec3 of_base(frame f, vec3 wi, vec2 u) {
    float r = sqrt(u.x);
    vec3 wo = vec3(r * cos(2.0 * PI * u.y), r * sin(2.0 * PI * u.y), sqrt(1.0 - u.x));
    vec3 passes = (vec3(1.0) - mirror(wi.z)) * (vec3(1.0) - mirror(wo.z)) * base_colour();
    return passes * wide_light(world(f, wo));
}

vec3 seen(vec3 eye, vec3 d, vec2 u_normal, vec2 u_lamp, vec2 u_base) {
    float b = dot(eye, d);
    float root = b * b - dot(eye, eye) + 1.0;
    if (root <= 0.0) {
        return min(wide_light(d), vec3(2.0)) * (light == 3 ? 1.0 : 0.6);
    }
    vec3 z = normalize(eye - d * (b + sqrt(root)));
    vec3 x = normalize(cross(vec3(0.0, 1.0, 1e-4), z));
    frame f = frame(x, cross(z, x), z);
    vec3 wi = local(f, -d);
    wi.z = max(wi.z, 1e-3);
    vndf_view view = vndf_view_of(surface_here(), normalize(wi));
    vec3 gets = vec3(0.0);
    for (int kind = 0; kind < 2; kind += 1) {
        gets += mirrored(f, view, kind == 1, kind == 1 ? u_lamp : u_normal);
    }
    if (material == 5) {
        gets += through_glass(f, view, u_base);
    } else if (material >= 3) {
        gets += of_base(f, view.wi, u_base) + lamp_on_base(f, view.wi, u_lamp);
    }
    return gets;
}

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    vec3 a = random_at(uvec3(pixel, 1u));
    vec3 b = random_at(uvec3(pixel, 2u));
    vec2 jitter = fract(a.xy + pixel_step) - 0.5;
    vec2 p = (2.0 * (gl_FragCoord.xy + jitter) - size) / size.y;
    vec3 eye = vec3(0.0, 1.1, 4.9);
    vec3 ahead = normalize(-eye);
    vec3 right = normalize(cross(ahead, vec3(0.0, 1.0, 0.0)));
    vec3 d = normalize(ahead + 0.245 * (p.x * right + p.y * cross(right, ahead)));
    vec3 gets = seen(eye, d, fract(vec2(a.z, b.x) + normal_step), fract(b.yz + lamp_step),
                     fract(vec2(a.y, b.x) + base_step));
    sum = vec4(gets, 1.0);
    if (!first) {
        sum += texelFetch(before, ivec2(gl_FragCoord.xy), 0);
    }
}
