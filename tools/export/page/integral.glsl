// The density on a grid over all slopes, times the solid angle of a cell.
uniform sampler2D columns; // where each lies between 0 and 1, and how wide it is
out vec4 part; // of the integral of the density, of facing times it, and of the true visible normals

void main() {
    vec2 column = texelFetch(columns, ivec2(gl_FragCoord.x, 0), 0).xy;
    float odds = column.x / (1.0 - column.x);
    float r = odds * odds * odds; // so that the last cell is far out in any tail
    float phi = 2.0 * PI * gl_FragCoord.y / size.y;
    vndf_view view = vndf_view_from(surface_here(), incident);
    vndf_affine_map m = view.f.m; // in units of the distribution's slopes
    vec2 unit = r * vec2(cos(phi), sin(phi));
    vec3 long_normal = vec3(m.xx * unit.x + m.xy * unit.y, m.yx * unit.x + m.yy * unit.y, 1.0);
    float per = 1.0 / length(long_normal);
    vec3 wm = long_normal * per;
    float area = 3.0 * r * odds * odds / ((1.0 - column.x) * (1.0 - column.x)) * column.y * 2.0 * PI / size.y;
    area = area * abs(m.xx * m.yy - m.xy * m.yx) * per * per * per;
    float mass = vndf_pdf(view, wm) * area;
    part = vec4(mass, mass * max(dot(incident, wm), 0.0), vndf_visible(view, wm) * area, 0.0);
}
