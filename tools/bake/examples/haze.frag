#version 330
// Direct light of a rectangle by linearly transformed cosines, and of an environment by the split sum, from the tables
// of `vndf bake tables/hazy.vndf --what dfg,ltc -o haze`: ltc_inverse.dds, ltc_norm.dds and dfg.dds as textures with linear
// filtering, clamped at their edges.
uniform sampler2D ltc_inverse, ltc_norm, dfg;
uniform vec3 corner[4]; // of the light, in turn, as seen from the point
uniform vec3 f0;
uniform float roughness;
in vec3 normal, view; // unit; view leads to the eye
out vec4 colour;

const float SIZE = 64.0;

// Places (i, j)/(n - 1) of a table with n x n texels.
vec2 at_edges(float u, float v)
{
    return (vec2(u, v) * (SIZE - 1.0) + 0.5) / SIZE;
}

// A part of the integral of the cosine over a polygon: an edge between unit vectors.
float edge(vec3 a, vec3 b)
{
    float cosine = clamp(dot(a, b), -0.9999, 0.9999);
    return cross(a, b).z * acos(cosine) / sqrt(1.0 - cosine * cosine);
}

// The part of the light that a cosine, transformed back, sees of the rectangle, all of it above the horizon.
float rectangle(mat3 inverse)
{
    vec3 l[4];
    float sum = 0.0;
    for (int i = 0; i < 4; i++)
        l[i] = normalize(inverse * corner[i]);
    for (int i = 0; i < 4; i++)
        sum += edge(l[i], l[(i + 1) % 4]);
    return abs(sum) / 6.2831853;
}

void main()
{
    float cosine = clamp(dot(normal, view), 0.0, 1.0);
    vec4 m = texture(ltc_inverse, at_edges(roughness, sqrt(1.0 - cosine)));
    vec2 norm = texture(ltc_norm, at_edges(roughness, sqrt(1.0 - cosine))).xy;
    vec3 x = normalize(view - normal * cosine + vec3(1e-6, 0.0, 0.0));
    mat3 frame = transpose(mat3(x, cross(normal, x), normal));
    mat3 inverse = mat3(m.x, 0.0, m.y, 0.0, 1.0, 0.0, m.z, 0.0, m.w) * frame;
    vec3 direct = rectangle(inverse) * (f0 * norm.x + (1.0 - f0) * norm.y);
    vec2 split = texture(dfg, vec2(cosine, roughness)).xy;
    colour = vec4(direct + f0 * split.x + split.y, 1.0);
}
