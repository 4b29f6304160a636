// What surfaces are lit by: a wide part, and a lamp, which is a cap of directions, or a rectangle that stands behind a
// floor; what they reflect; and frames on them. y is up, but on a floor, where z is.

uniform int light;   // 0 sky, 1 studio, 2 lamp in the dark, 3 white room, 4 nothing but the lamp
uniform bool is_floor;
uniform bool is_engine; // it is compared with what engines make of it
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
    if (light >= 3) {
        return vec3(light == 3 ? 1.0 : 0.0);
    }
    return mix(vec3(0.02), vec3(0.06, 0.065, 0.08), smoothstep(-0.6, 0.9, d.y));
}

const vec3 CORNER = vec3(-1.1, 1.6, 0.25); // of the rectangle
const vec2 SIDES = vec2(2.2, 1.1);         // along x and z

// The distance at which a ray meets the rectangle, 0: nowhere.
float rectangle_at(vec3 from, vec3 d) {
    float t = (CORNER.y - from.y) / d.y;
    vec2 p = (from + t * d - CORNER).xz / SIDES;
    return t > 0.0 && all(greaterThan(p, vec2(0.0))) && all(lessThan(p, vec2(1.0))) ? t : 0.0;
}

// Per steradian, of lamp_direction; 0 where a direction misses the lamp.
float lamp_density(vec3 from, vec3 d) {
    if (is_floor) {
        float t = rectangle_at(from, d);
        return t * t / (abs(d.y) * SIDES.x * SIDES.y);
    }
    return dot(d, lamp.xyz) > lamp.w ? 1.0 / (2.0 * PI * (1.0 - lamp.w)) : 0.0;
}

vec3 lamp_direction(vec3 from, vec2 u) {
    if (is_floor) {
        return normalize(CORNER + vec3(u.x * SIDES.x, 0.0, u.y * SIDES.y) - from);
    }
    float z = mix(lamp.w, 1.0, u.x);
    float r = sqrt(max(1.0 - z * z, 0.0));
    vec3 side = normalize(cross(lamp.xyz, abs(lamp.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    return r * cos(2.0 * PI * u.y) * side + r * sin(2.0 * PI * u.y) * cross(lamp.xyz, side) + z * lamp.xyz;
}

uniform int material; // 0 gold, 1 copper, 2 silver, 3 red plastic, 4 black plastic, 5 glass

// What is reflected of light from straight above.
vec3 front_colour() {
    vec3 front = material == 0 ? vec3(1.022, 0.782, 0.344) : vec3(0.972, 0.96, 0.915);
    front = material == 1 ? vec3(0.955, 0.638, 0.538) : front;
    return material >= 3 ? vec3(0.04) : front;
}

// The axes at a point of a surface, whose normal is z.
struct frame {
    vec3 x, y, z;
};

vec3 local(frame f, vec3 w) {
    return vec3(dot(w, f.x), dot(w, f.y), dot(w, f.z));
}

vec3 world(frame f, vec3 w) {
    return w.x * f.x + w.y * f.y + w.z * f.z;
}
