/* Meshes are what their files say, scaled, turned and moved; broken files are refused with file, line and reason,
 * and add nothing. Notices indices off by one or taken from the wrong end, polygons cut wrongly, v not flipped,
 * normals that do not win over the order of corners, and a reader that accepts nonsense. */
#include "harness/test.h"
#include "render/geometry.h"

static int read_text(geometry *g, const char *text, const placement *where, char message[256])
{
    message[0] = '\0';
    return obj_read_text(g, "x.obj", text, strlen(text), where, 7, message, 256);
}

static const placement as_it_is = {1, 0, {0, 0, 0}};

static void test_refusals(void)
{
    static const struct {
        const char *text, *says;
    } bad[] = {
        {"", "x.obj:1: the file ends here without a triangle that has an area"},
        {"v 0 0 0\nv 1 0\n", "x.obj:2: v has 2 numbers, it should have 3"},
        {"v 0 0 nan\n", "x.obj:1: 'nan' should be a number"},
        {"v 0 0 0x1\n", "x.obj:1: '0x1' should be a number"},
        {"v 0 0 1e99\n", "x.obj:1: '1e99' is too large a number"},
        {"v 0 0 1e9\n", "x.obj:1: this corner lies farther than 1e+07 from the origin"},
        {"vt 1e9\n", "x.obj:1: a texture coordinate is beyond 1e+06"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "x.obj:4: f has 2 corners, it should have 3 or more"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "x.obj:4: '4': there are 3 corners (v) so far"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "x.obj:4: '-4': there are 3 corners (v) so far"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "x.obj:4: '0': corners (v) are counted from 1"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2 3\n", "x.obj:4: '1/1': there are 0 texture coordinates (vt) so far"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2 3\n", "x.obj:4: '1/' should be v, v/vt, v//vn or v/vt/vn, in numbers"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1a 2 3\n", "x.obj:4: '1a' should end after '1'"},
        {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "x.obj:4: the file ends here without a triangle"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        geometry g = {NULL, 0, 0, NULL};
        char message[256];
        if (!(TEST(!read_text(&g, bad[i].text, &as_it_is, message)) & TEST_HAS(message, bad[i].says) &
              TEST(g.count == 0)))
            fprintf(stderr, "    %s    says %s\n", bad[i].text, message);
        geometry_free(&g);
    }
    geometry g = {NULL, 0, 0, NULL};
    char message[256];
    TEST(!obj_read_text(&g, "x.obj", "v 0\0 0", 6, &as_it_is, 0, message, sizeof message));
    TEST_HAS(message, "x.obj:1: the file has a byte 0");
    TEST(!obj_read(&g, "no/such.obj", &as_it_is, 0, message, sizeof message));
    TEST_HAS(message, "no/such.obj: No such file");
}

static void test_square(const char *text)
{
    geometry g = {NULL, 0, 0, NULL};
    char message[256];
    if (!TEST(read_text(&g, text, &as_it_is, message)) || !TEST(g.count == 2 && geometry_build(&g))) {
        fprintf(stderr, "    %s    says %s\n", text, message);
        return;
    }
    for (int i = 0; i < 4; i++) {
        const double x = i % 2 ? 0.75 : 0.25, y = i / 2 ? 0.75 : 0.25;
        const ray r = {{x, y, 3}, {0, 0, -1}, HUGE_VAL};
        hit h;
        TEST(geometry_hit(&g, &r, &h) && h.normal.z > 0.999 && fabs(h.distance - 3) < 1e-12 &&
             h.shape->material == 7);
        TEST_NEAR(h.u, x, 1e-6);
        TEST_NEAR(h.v, 1 - y, 1e-6);
    }
    geometry_free(&g);
}

/* A quarter turn takes z to x. */
static void test_placement(void)
{
    const placement where = {2, 90, {10, 20, 30}};
    geometry g = {NULL, 0, 0, NULL};
    char message[256];
    TEST(read_text(&g, "v 0 0 1\nv 0 0 2\nv 0 1 1\nvn 0 0 3\nf 1//1 2//1 3//1\n", &where, message) &&
         g.count == 1);
    TEST_NEAR(g.shapes[0].corner.x, 12, 1e-12);
    TEST_NEAR(g.shapes[0].corner.y, 20, 1e-12);
    TEST_NEAR(g.shapes[0].corner.z, 30, 1e-12);
    TEST_NEAR((double)g.shapes[0].normal[0].x, 1, 1e-6);
    geometry_free(&g);
}

int main(void)
{
#define CORNERS "v 0 0 0\nv 1 0 0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 9\n"
    test_refusals();
    test_square(CORNERS "f 1/1 2/2 3/3 4/4\n");
    test_square(CORNERS "# a comment\no name\nf -4/-4 -3/-3 -2/-2 -1/-1 # more\r\n");
    test_square(CORNERS "f 1/1/1 2/2/1 3/3/1 4/4/1");
    test_square(CORNERS "f 4/4/1 3/3/1 2/2/1 1/1/1\n"); /* the other way round; normals win */
    test_placement();
    return test_done();
}
