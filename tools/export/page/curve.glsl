// D along the x axis, from the mean normal to the angle `last`.
uniform float last;
out vec4 value;

void main() {
    float angle = last * (gl_FragCoord.x - 0.5) / (size.x - 1.0);
    vndf_surface along = vndf_rough(distribution, alpha.x, alpha.y);
    value = vec4(vndf_ndf(along, vec3(sin(angle), 0.0, cos(angle))), angle, 0.0, 1.0);
}
