/* OBJ files: triangles as the file has them, placed; every error with its file, line and what is wrong, and
 * nothing added; hostile files take bounded memory. */
#include <stdlib.h>

#include "render/render_case.h"

static const placement as_is = {1.0f, 0.0f, {0.0f, 0.0f, 0.0f}};

/* Reads text as a file "t.obj". */
static int read_bytes(geometry *g, const char *text, size_t length, const placement *where, char message[256])
{
    FILE *file = tmpfile();
    message[0] = '\0';
    if (!TEST(file != NULL))
        return 0;
    TEST(fwrite(text, 1, length, file) == length);
    rewind(file);
    const int is_read = geometry_read_obj(g, file, "t.obj", where, 5, message, 256);
    fclose(file);
    return is_read;
}

static int read_text(geometry *g, const char *text, const placement *where, char message[256])
{
    return read_bytes(g, text, strlen(text), where, message);
}

static void expect_corner(const triangle *t, int i, double x, double y, double z)
{
    TEST_NEAR((double)t->corner[i].x, x, 1e-6);
    TEST_NEAR((double)t->corner[i].y, y, 1e-6);
    TEST_NEAR((double)t->corner[i].z, z, 1e-6);
}

static void test_forms(void)
{
    geometry g = {0};
    char message[256];
    TEST(read_text(&g,
                   "# comment\r\nmtllib none\r\no thing\n\n"
                   "  v 0 0 0\nv\t1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0 # up\n"
                   "vt 0 0\nvt 1 0 0\nvt .25 1e0\nvn 0 0 2\ns off\nusemtl a/b\n"
                   "f 1 2 3 4\nf -4/1 -3/2 \\\r\n  -2/3\nf 1//1 2//1 3//-1\nf 1/1/1 2/-2/1 3/3/1\nf 1 1 2\nl 1 2",
                   &as_is, message));
    TEST(g.triangle_count == 5 && g.shape_count == 5); /* two of the square, three others, none without area */
    if (g.triangle_count == 5) {
        expect_corner(&g.triangles[1], 0, 0.0, 0.0, 0.0);
        expect_corner(&g.triangles[1], 1, 1.0, 1.0, 0.0);
        expect_corner(&g.triangles[1], 2, 0.0, 1.0, 0.0);
        expect_corner(&g.triangles[2], 2, 1.0, 1.0, 0.0);
        TEST(g.triangles[2].u[2] == 0.25f && g.triangles[2].v[2] == 0.0f && g.triangles[2].v[0] == 1.0f);
        TEST(g.triangles[3].normal[2].z == 1.0f && g.triangles[2].normal[0].z == 0.0f);
        TEST(g.triangles[4].u[1] == 1.0f && g.triangles[4].normal[1].z == 1.0f);
        TEST(g.shapes[4].material == 5 && g.shapes[4].kind == SHAPE_TRIANGLE);
    }
    geometry_free(&g);
}

/* Scaled, turned from z towards x, moved; the side that is outwards stays so in a mirror. */
static void test_placement(void)
{
    static const char *const texts[] = {"v 0 0 0\nv 0 0 1\nv 0 1 0\nf 3 2 1\n",
                                        "v 0 0 0\nv 0 0 1\nv 0 1 0\nvn -1 0 0\nf 3//1 2//1 1//1\n"};
    const placement turned = {2.0f, 90.0f, {10.0f, 20.0f, 30.0f}}, mirrored = {-1.0f, 0.0f, {0.0f, 0.0f, 0.0f}};
    char message[256];
    for (int i = 0; i < 2; i++) { /* the second has normals against the order of its corners */
        geometry g = {0};
        const ray from_x = ray_along(vec(5.0f, 0.25f, 0.25f), vec(-1.0f, 0.0f, 0.0f));
        const ray through = ray_along(vec(5.0f, -0.25f, -0.25f), vec(-1.0f, 0.0f, 0.0f));
        hit h;
        TEST(read_text(&g, texts[i], &as_is, message) && read_text(&g, texts[i], &turned, message));
        TEST(g.triangle_count == 2);
        expect_corner(&g.triangles[1], 0, 10.0, 22.0, 30.0);
        expect_corner(&g.triangles[1], 1 + i, 12.0, 20.0, 30.0);
        TEST(read_text(&g, texts[i], &mirrored, message) && geometry_build(&g));
        TEST(geometry_hit(&g, &from_x, &h) && h.normal.x == (i ? -1.0f : 1.0f) && h.shading.z.x == h.normal.x);
        TEST(geometry_hit(&g, &through, &h) && h.normal.x == (i ? 1.0f : -1.0f) && h.shading.z.x == h.normal.x);
        geometry_free(&g);
    }
}

static void test_errors(void)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"v 0 0 0\nv 1 0\n", "t.obj:2: v has 2 numbers, it should have 3"},
        {"\n\nv 1 x 2\n", "t.obj:3: 'x' should be a number"},
        {"v 1 nan 2\n", "t.obj:1: 'nan' should be a number"},
        {"v 0x1 0 0\n", "t.obj:1: '0x1' should be a number"},
        {"v 1 2 1e999\n", "t.obj:1: '1e999' is too large a number"},
        {"v 1 2 1e31\n", "t.obj:1: this corner lies farther than 1e+30 from the origin"},
        {"v 1 2 3 4 5 6 7 8\n", "t.obj:1: v has more than 7 numbers"},
        {"vt\n", "t.obj:1: vt has 0 numbers, it should have 1"},
        {"vt 1e9\n", "t.obj:1: a texture coordinate is beyond"},
        {"vn 1\n", "t.obj:1: vn has 1 number, it should have 3"},
        {"v 0 0 0\r\nv 1 0 0\r\n\r\nf 1 2\r\n", "t.obj:4: f has 2 corners, it should have 3 or more"},
        {"v 0 0 0\nf 1 2 1\n", "t.obj:2: '2': there are 1 corners (v) so far"},
        {"v 0 0 0\nf 1 -2 1\n", "t.obj:2: '-2': there are 1 corners (v) so far"},
        {"v 0 0 0\nf 1 0 1\n", "t.obj:2: '0': corners (v) are counted from 1"},
        {"v 0 0 0\nf 1 1/1 1\n", "t.obj:2: '1/1': there are 0 texture coordinates (vt) so far"},
        {"v 0 0 0\nf 1 1//7 1\n", "t.obj:2: '1//7': there are 0 normals (vn) so far"},
        {"v 0 0 0\nf 1 1/a 1\n", "t.obj:2: '1/a' should be v, v/vt, v//vn or v/vt/vn"},
        {"v 0 0 0\nf 1 1x 1\n", "t.obj:2: '1x' should end after '1'"},
        {"v 0 0 0\nf 1 99999999999999999999 1\n", "there are 1 corners (v) so far"},
        {"v 0 0 0\nf 1 -99999999999999999999 1\n", "there are 1 corners (v) so far"},
        {"v 0 0 \\ 0\n", "t.obj:1: a backslash stands only at the end of a line"},
        {"v 0 0 \\\n x\n", "t.obj:2: 'x' should be a number"},
        {"v 0 0 0\n", "t.obj:2: the file ends here without a triangle"},
        {"", "t.obj:1: the file ends here without a triangle"},
        {"v 0 0 0\nf 1 1 1", "t.obj:2: the file ends here without a triangle that has an area"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 9\n", "t.obj:4: '9'"},
        {"v 1 \033[1m 2\n", "t.obj:1: '?[1m' should be a number"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        geometry g = {0};
        const sphere s = {{0.0f, 0.0f, 0.0f}, 1.0f};
        char message[256];
        TEST(geometry_add_sphere(&g, s, 0));
        TEST(!read_text(&g, cases[i].text, &as_is, message));
        TEST_HAS(message, cases[i].message);
        TEST(g.shape_count == 1 && g.triangle_count == 0 && geometry_build(&g));
        geometry_free(&g);
    }
}

static void test_files(void)
{
    geometry g = {0};
    char message[256];
    TEST(!geometry_add_obj(&g, VNDF_SOURCE_DIR "/no such.obj", &as_is, 0, message, sizeof message));
    TEST_HAS(message, "no such.obj: cannot be opened: ");
    TEST(!geometry_add_obj(&g, VNDF_SOURCE_DIR, &as_is, 0, message, sizeof message)); /* a folder */
    TEST_HAS(message, VNDF_SOURCE_DIR ":");
    message[0] = 'x';
    TEST(!geometry_add_obj(&g, VNDF_SOURCE_DIR "/no such.obj", &as_is, 0, message, 1) && message[0] == '\0');
    geometry_free(&g);
}

/* Some devices have no end. */
static void test_endless(void)
{
    geometry g = {0};
    char message[256];
    FILE *device = test_quick() ? NULL : fopen("/dev/zero", "rb");
    if (!device)
        return;
    TEST(!geometry_read_obj(&g, device, "endless", &as_is, 0, message, sizeof message));
    TEST_HAS(message, "endless:1: the file has more than 1073741824 bytes");
    fclose(device);
}

static char *repeated(const char *head, const char *part, size_t times, size_t *length)
{
    const size_t first = strlen(head), each = strlen(part);
    char *text = malloc(first + times * each + 1);
    if (!TEST(text != NULL))
        exit(test_done());
    memcpy(text, head, first + 1);
    for (size_t i = 0; i < times; i++)
        memcpy(text + first + i * each, part, each + 1);
    *length = first + times * each;
    return text;
}

/* Long words, lines, comments and polygons; bytes that are no text. */
static void test_hostile(void)
{
    static const struct {
        const char *head, *part;
        size_t times;
        const char *message; /* NULL: it is read */
    } cases[] = {
        {"v 0 0 ", "1", 1000000, "t.obj:1: '11111111111111111111...' is longer than 63 letters"},
        {"v 0 0 ", "0 ", 1000000, "t.obj:1: v has more than 7 numbers"},
        {"f ", "/", 1000000, "t.obj:1: '////////////////////...' is longer"},
        {"", "keyword", 200000, "t.obj:1: the file ends here"},
        {"# ", "comment ", 200000, "t.obj:1: the file ends here"},
        {"v", " ", 1000000, "t.obj:1: v has 0 numbers"},
        {"", "\n", 1000000, "t.obj:1000001: the file ends here"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", " 1 2 3", 20000, NULL},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", " \\\n", 200000, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        geometry g = {0};
        char message[256];
        size_t length;
        char *text = repeated(cases[i].head, cases[i].part, cases[i].times, &length);
        TEST(read_bytes(&g, text, length, &as_is, message) == (cases[i].message == NULL));
        TEST_HAS(message, cases[i].message ? cases[i].message : "");
        free(text);
        geometry_free(&g);
    }
    geometry g = {0};
    char message[256];
    TEST(!read_bytes(&g, "v 0 0 \0 0", 9, &as_is, message));
    TEST_HAS(message, "t.obj:1: '?' should be a number");
    geometry_free(&g);
}

/* The mesh of the shipped scenes is closed, faces outwards, and its shading normals are near the geometric. */
static void test_shipped_mesh(void)
{
    geometry g = {0};
    char message[256] = "";
    unsigned long long state = 0x4707;
    int met = 0, inwards = 0, odd = 0;
    const char *path = VNDF_SOURCE_DIR "/tools/scenes/knot.obj";
    if (!TEST(geometry_add_obj(&g, path, &as_is, 0, message, sizeof message) && geometry_build(&g)))
        fprintf(stderr, "%s\n", message);
    for (int i = 0; i < 20000; i++) {
        const vndf_vec3 from = scale(random_direction(&state), 5.0f);
        ray r = ray_along(from, unit(subtract(point_in_box(&state, 1.0f), from)));
        int crossings = 0;
        for (hit h; geometry_hit(&g, &r, &h) && crossings < 100; crossings++) {
            inwards += (dot(h.normal, r.direction) < 0.0f) != (crossings % 2 == 0);
            TEST(dot(h.shading.z, h.normal) > 0.8f);
            r = ray_from(&h, r.direction);
        }
        met += crossings > 0;
        odd += crossings % 2;
    }
    TEST(met > 5000 && g.triangle_count == 3072);
    TEST_NEAR(inwards, 0, 0);
    TEST_NEAR(odd, 0, 0);
    geometry_free(&g);
}

int main(void)
{
    test_forms();
    test_placement();
    test_errors();
    test_files();
    test_endless();
    test_hostile();
    test_shipped_mesh();
    return test_done();
}
