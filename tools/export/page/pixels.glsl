// One more sample of each pixel: of a unit sphere, or of a floor under a rectangle that shines.

uniform highp sampler2D before; // the sums of the samples so far
uniform bool first;
uniform vec2 pixel_step, normal_step, lamp_step, base_step; // from one sample to the next
uniform vec3 eye, target, up;
uniform float wide_angle;
out vec4 sum;

// At a point whose light goes to the eye, by three pairs of uniform numbers.
vec3 shaded(vec3 at, vec3 normal, vec3 to_eye, vec2 u_normal, vec2 u_lamp, vec2 u_base);

vec3 seen(vec3 d, vec2 u_normal, vec2 u_lamp, vec2 u_base) {
    if (is_floor) {
        float down = d.z < 0.0 ? -eye.z / d.z : 0.0;
        if (rectangle_at(eye, d) > 0.0 || down <= 0.0) {
            return rectangle_at(eye, d) > 0.0 ? shine : vec3(0.0);
        }
        return shaded(vec3((eye + down * d).xy, 0.0), vec3(0.0, 0.0, 1.0), -d, u_normal, u_lamp, u_base);
    }
    float b = dot(eye, d);
    float root = b * b - dot(eye, eye) + 1.0;
    if (root <= 0.0) {
        return is_engine ? vec3(0.0) : min(wide_light(d), vec3(2.0)) * (light == 3 ? 1.0 : 0.6);
    }
    vec3 at = normalize(eye - d * (b + sqrt(root)));
    return shaded(at, at, -d, u_normal, u_lamp, u_base);
}

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    vec3 a = random_at(uvec3(pixel, 1u));
    vec3 b = random_at(uvec3(pixel, 2u));
    vec2 jitter = fract(a.xy + pixel_step) - 0.5;
    vec2 p = (2.0 * (gl_FragCoord.xy + jitter) - size) / size.y;
    vec3 ahead = normalize(target - eye);
    vec3 right = normalize(cross(ahead, up));
    vec3 d = normalize(ahead + wide_angle * (p.x * right + p.y * cross(right, ahead)));
    sum = vec4(seen(d, fract(vec2(a.z, b.x) + normal_step), fract(b.yz + lamp_step), fract(vec2(a.y, b.x) + base_step)),
               1.0);
    if (!first) {
        sum += texelFetch(before, ivec2(gl_FragCoord.xy), 0);
    }
}
