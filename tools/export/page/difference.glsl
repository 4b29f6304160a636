// One pass beside samples: red where it is too bright, blue where it is too dark, whole at the mean light.
uniform highp sampler2D passes, samples;
uniform float mean;
uniform vec3 back; // the colour of no difference
out vec4 colour;

void main() {
    vec4 a = texelFetch(passes, ivec2(gl_FragCoord.xy), 0);
    vec4 b = texelFetch(samples, ivec2(gl_FragCoord.xy), 0);
    vec3 off = (a.rgb / a.a - b.rgb / b.a) / mean;
    float by = clamp(dot(off, vec3(0.2126, 0.7152, 0.0722)), -1.0, 1.0);
    colour = vec4(mix(back, by > 0.0 ? vec3(0.80, 0.10, 0.05) : vec3(0.05, 0.25, 0.75), abs(by)), 1.0);
}
