// The mean of the sums as colours of a screen.
uniform highp sampler2D sums;
uniform float exposure;
out vec4 colour;

void main() {
    vec4 sum = texelFetch(sums, ivec2(gl_FragCoord.xy), 0);
    vec3 x = exposure * sum.rgb / max(sum.a, 1.0);
    // A curve of films (Narkowicz 2015), then sRGB.
    x = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    colour = vec4(mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x)), 1.0);
}
