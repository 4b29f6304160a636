// Orange, with an edge.
uniform float width;
uniform vec3 edge_colour;
out vec4 colour;

void main() {
    float from_edge = (0.5 - length(gl_PointCoord - 0.5)) * width;
    float inner = clamp(from_edge - 0.18 * width + 0.5, 0.0, 1.0);
    float outer = clamp(from_edge + 0.5, 0.0, 1.0);
    colour = vec4(mix(edge_colour, vec3(0.969, 0.404, 0.027), inner), 1.0) * outer;
}
