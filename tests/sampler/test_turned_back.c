/* A normal that rounding has turned away from wi by a hair is turned back by little more: the result faces wi and lies
 * within 1e-4, in units of the roughness, of what was drawn, for any direction and any roughness from 1e-3 to 3. */
#include "harness/constants.h"
#include "harness/test.h"
#include "sampler/frame.h"

/* A unit problem whose wi is at `angle`, and a normal 1e-7 beyond its horizon. */
static void test_one(unsigned long long *state)
{
    double angle = (0.1 + 2.5 * test_uniform_double(state)), phi = 2 * PI * test_uniform_double(state);
    double alpha = 1e-3 * pow(3000, test_uniform_double(state)), a = PI / 2 + 0.4 * test_uniform_double(state);
    float s = (float)sin(angle), c = (float)cos(angle);
    vndf_frame f = {{0, 0, 0}, alpha, alpha, s, c, (float)cos(phi), (float)sin(phi)};
    /* wi' ~ (s, 0, c): the real wi has its level part over alpha */
    double x = (double)s / alpha, length = sqrt(x * x + (double)c * c);
    f.wi =
        (vndf_vec3){(float)(x * cos(phi) / length), (float)(x * sin(phi) / length), (float)((double)c / length)};
    /* c z + s cos(a) r = 0 on the horizon */
    double r = -(double)c / ((double)s * cos(a)), z = 1 / sqrt(1 + r * r);
    if (!(r > 0.05 && r < 20)) /* the horizon is not at this azimuth */
        return;
    vndf_vec3 n = {(float)(r * z * cos(a) - 1e-7 * (double)s), (float)(r * z * sin(a)),
                   (float)(z - 1e-7 * (double)c)};
    vndf_vec3 wm = vndf_normalize(vndf_from_unit(&f, n));
    if (vndf_exact_dot(f.wi, wm) > 0.0)
        return;
    vndf_vec3 back = vndf_turn_to_face(&f, wm), at = vndf_normalize(vndf_to_unit(&f, back)),
              from = vndf_normalize(n);
    double off = hypot(hypot((double)(at.x - from.x), (double)(at.y - from.y)), (double)(at.z - from.z));
    TEST(vndf_exact_dot(f.wi, back) > 0.0 && back.z >= 0.0f);
    TEST(off < 1e-4);
}

int main(void)
{
    unsigned long long state = 5;
    for (int i = 0; i < 200000; i++)
        test_one(&state);
    return test_done();
}
