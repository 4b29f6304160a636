/* A scene file becomes what it says, every statement and clause of it; what is wrong is refused with the line and
 * the column where it stands and what would be right; and the scenes that are shipped are good. */
#include "test.h"

#include <stdlib.h>

#include "geometry_stub.h"
#include "render/scene.h"

enum { MESSAGE = 1024 };

/* Reads text as the file tests/x.scene. */
static int read_text(scene *made, const char *text, char message[MESSAGE])
{
    size_t length = strlen(text);
    char *copy = malloc(length + 1);
    if (!copy)
        return 0;
    memcpy(copy, text, length + 1);
    message[0] = '\0';
    int good = scene_read_text(made, VNDF_SOURCE_DIR "/tests/x.scene", copy, length, message, MESSAGE);
    free(copy);
    return good;
}

static const material *material_of(const scene *s, const char *name)
{
    for (size_t i = 0; i < s->material_count; i++)
        if (strcmp(s->materials[i].name, name) == 0)
            return &s->materials[i];
    TEST(!"the material is there");
    return NULL;
}

/* ---- what is right ---- */

static void test_settings(void)
{
    static const char text[] = "# all settings\r\n"
                               "title \"A # title\" # a comment\n"
                               "film height 30 width 20\n"
                               "camera to 1 2 3 field 55.5 from\n"
                               "\t-1 -2e0 -.5 up 1 0 0\n"
                               "integrator exposure 0.5 samples 1e3 depth 7 roulette 3#comment\n"
                               "image sky pattern studio width 32 height 16\n"
                               "environment image sky scale 2 turn -30 constant 0.1 0.2 0.3";
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s, text, message))) {
        fprintf(stderr, "%s\n", message);
        return;
    }
    TEST(strcmp(s.title, "A # title") == 0 && s.width == 20 && s.height == 30);
    TEST(s.camera.to.z == 3.0f && s.camera.from.y == -2.0f && s.camera.from.z == -0.5f);
    TEST(s.camera.up.x == 1.0f);
    TEST(s.camera.field == 55.5f);
    TEST(s.integrator.depth == 7 && s.integrator.roulette == 3 && s.integrator.samples == 1000);
    TEST(s.integrator.exposure == 0.5f);
    TEST(s.image_count == 1 && s.images[0].width == 32 && s.images[0].height == 16);
    TEST(s.environment.map == &s.images[0] && s.environment.scale == 2.0f && s.environment.turn == -30.0f);
    TEST(s.environment.constant[2] == 0.3f);
    scene_free(&s);
}

static void test_defaults(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s, "camera from 0 0 1 to 0 0 0\nenvironment constant 1 1 1\n", message)))
        return;
    TEST(s.title == NULL && s.width == 640 && s.height == 360);
    TEST(s.camera.field == 40.0f && s.camera.up.y == 1.0f);
    TEST(s.integrator.depth == 12 && s.integrator.roulette == 4 && s.integrator.samples == 64);
    TEST(s.integrator.exposure == 1.0f && s.environment.map == NULL && s.environment.scale == 1.0f);
    scene_free(&s);
    TEST(s.materials == NULL && s.title == NULL);
}

#define LIT "camera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"

static void check_optics(const scene *s)
{
    const material *m = material_of(s, "a");
    TEST(m && m->is.effects.fresnel == VNDF_FRESNEL_CONDUCTOR && m->is.effects.lobes == VNDF_LOBES_REFLECTION);
    TEST(m && m->is.conductor_eta[0] < 0.2f && m->is.conductor_k[0] > 3.9f && m->is.alpha_x == 0.2f &&
         m->is.alpha_y == 0.2f && m->is.distribution == vndf_ggx());
    m = material_of(s, "b");
    TEST(m && m->is.conductor_eta[1] == 2.0f && m->is.conductor_k[2] == 6.0f && m->is.alpha_y == 0.4f);
    TEST(m && m->is.effects.masking == VNDF_MASKING_V_CAVITIES && m->is.effects.normals == VNDF_NORMALS_V_CAVITY &&
         m->is.distribution == vndf_beckmann());
    m = material_of(s, "c");
    TEST(m && m->is.effects.fresnel == VNDF_FRESNEL_DIELECTRIC && m->is.effects.lobes == VNDF_LOBES_BOTH);
    TEST(m && m->is.eta == 1.5f && m->absorb[1] == 2.0f && m->is.effects.scattering == VNDF_SCATTERING_MULTIPLE &&
         m->is.order_limit == 9);
    m = material_of(s, "d");
    TEST(m && m->is.effects.fresnel == VNDF_FRESNEL_SCHLICK && m->is.f0[2] == 0.3f && m->colour[0] == 0.5f);
    TEST(m && m->is.effects.axes == VNDF_AXES_ROTATED && m->is.effects.normals == VNDF_NORMALS_ALL);
    TEST_NEAR(m ? (double)m->is.rotation : 0.0, 0.78539816339, 1e-6);
    m = material_of(s, "e");
    TEST(m && m->is.effects.fresnel == VNDF_FRESNEL_NONE && m->is.effects.masking == VNDF_MASKING_SEPARABLE);
}

static void test_rough_materials(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s, LIT
                        "material a conductor of gold distribution ggx alpha 0.2\n"
                        "material b conductor eta 1 2 3 k 4 5 6 distribution beckmann alpha 0.2 0.4\n"
                        "  masking v-cavities normals v-cavity\n"
                        "material c dielectric index 1.5 distribution ggx alpha 0.3 absorb 1 2 3\n"
                        " scattering multiple order 9\n"
                        "material d reflector f0 0.1 0.2 0.3 distribution table ../tables/hazy.vndf normals all\n"
                        " rotation 45 colour 0.5 0.5 0.5\n"
                        "material e shape distribution family ggx bytes 2048 alpha 0.5 masking separable\n"
                        "material f shape distribution table ../tables/hazy.vndf alpha 2\n"
                        "material g dielectric lobes transmission index 1.3 distribution ggx alpha 0.1\n",
                        message))) {
        fprintf(stderr, "%s\n", message);
        return;
    }
    check_optics(&s);
    TEST(s.table_count == 2); /* hazy once, and the family */
    const material *f = material_of(&s, "f"), *g = material_of(&s, "g"), *d = material_of(&s, "d");
    TEST(f && d && f->is.distribution == d->is.distribution && d->is.alpha_x == 1.0f && f->is.alpha_x == 2.0f);
    TEST(g && g->is.effects.lobes == VNDF_LOBES_TRANSMISSION);
    for (size_t i = 0; i < s.material_count; i++) {
        vndf_bsdf b;
        TEST(s.materials[i].kind == MATERIAL_MICROFACET && !s.materials[i].is_textured);
        TEST(vndf_bsdf_at(&b, &s.materials[i].bsdf, vec(0.6f, 0.0f, 0.8f)));
    }
    scene_free(&s);
}

static void test_plain_materials(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s, LIT
                        "image m pattern ramp\nimage n pattern noise\n"
                        "material a matte colour 0.1 0.2 0.3 colour-map m\nmaterial b mirror\n"
                        "material c glass index 1.33 absorb 0 0 1\nmaterial d light radiance 5 6 7\n"
                        "material e conductor of silver distribution ggx alpha 0.5 alpha-map m\n"
                        "material f conductor of silver distribution ggx alpha 0.5 0.2 alpha-y-map n\n",
                        message))) {
        fprintf(stderr, "%s\n", message);
        return;
    }
    const material *m = s.materials;
    TEST(s.material_count == 6 && s.images[0].width == 512);
    TEST(m[0].kind == MATERIAL_MATTE && m[0].colour[2] == 0.3f && m[0].colour_map == &s.images[0]);
    TEST(m[1].kind == MATERIAL_MIRROR && m[1].colour[0] == 1.0f && !m[1].colour_map);
    TEST(m[2].kind == MATERIAL_GLASS && m[2].is.eta == 1.33f && m[2].absorb[2] == 1.0f);
    TEST(m[3].kind == MATERIAL_LIGHT && m[3].colour[0] == 5.0f);
    TEST(m[4].is_textured && m[4].alpha_x.map == &s.images[0] && m[4].alpha_y.map == &s.images[0]);
    TEST(m[5].is_textured && !m[5].alpha_x.map && m[5].alpha_y.map == &s.images[1] && m[5].alpha_y.value == 0.2f);
    scene_free(&s);
}

static void test_shapes(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s, LIT
                        "material radius matte colour 1 1 1\n" /* a name may be a keyword */
                        "material b matte colour 0 0 0\n"
                        "sphere material radius radius 2 centre 1 2 3\n"
                        "rectangle corner 1 1 1 edge-u 2 0 0 edge-v 0.001 3 0 material b\n"
                        "box from 1 -1 1 to -1 1 -1 material b\n",
                        message))) {
        fprintf(stderr, "%s\n", message);
        return;
    }
    const geometry *g = &s.geometry;
    TEST(g->sphere_count == 1 && g->spheres[0].radius == 2.0f && g->spheres[0].centre.z == 3.0f);
    TEST(g->rectangle_count == 7 && g->rectangles[0].edge_u.x == 2.0f && g->rectangles[0].corner.x == 1.0f);
    TEST(fabsf(dot(g->rectangles[0].edge_u, g->rectangles[0].edge_v)) < 1e-6f); /* made square */
    TEST(g->shape_count == 8 && g->shapes[0].material == 0 && g->shapes[7].material == 1);
    scene_free(&s);
}

/* ---- what is wrong ---- */

typedef struct wrong {
    const char *text, *message; /* the message from its line on */
} wrong;

static void refused(const char *before, const wrong *w)
{
    scene s;
    char message[MESSAGE], text[4096], want[MESSAGE];
    snprintf(text, sizeof text, "%s%s", before, w->text);
    snprintf(want, sizeof want, "%s/tests/x.scene:%s", VNDF_SOURCE_DIR, w->message);
    int good = read_text(&s, text, message);
    if (!TEST(!good))
        scene_free(&s);
    if (!TEST(strncmp(message, want, strlen(want)) == 0))
        fprintf(stderr, "  of: %s\n  got:  %s\n  want: %s\n", w->text, message, want);
    TEST(s.materials == NULL && s.images == NULL); /* nothing is left */
}

/* Alone in their file. */
static const wrong words[] = {
    {"", "1:1: the scene ends without a camera"},
    {" camera from 0 0 1 to 0 0 0", "1:2: a statement begins in the first column"},
    {"# c\ntitle \"a b\n\"", "2:7: the quote that begins here does not end on its line"},
    {"title \"a\"b", "1:10: a blank is missing before this"},
    {"title a\"b\"", "1:8: a blank is missing before this"},
    {"title \x01", "1:7: a byte 1, which is no text"},
    {"title a\x7f", "1:8: a byte that is no text"},
    {"title", "1:1: 'title' takes one word"},
    {"title a b", "1:9: 'title' takes one word"},
    {"title a\n\ntitle b", "3:1: 'title' stands in this scene twice"},
    {"tilte a", "1:1: 'tilte' is no statement; did you mean 'title'?"},
    {"\"title\" a", "1:1: 'title' is no statement"},
    {"fnord", "1:1: 'fnord' is no statement; it must be one of: title, film, camera,"},
    {"camera from 0 0 1 to 0 0 0\n", "1:27: the scene ends without light"},
    {"environment constant 1 1 1", "1:27: the scene ends without a camera"},
    {"camera from 0 0 1 to 0 0 0\nenvironment constant 0 0 0", "2:27: the scene ends without light"},
};

static const wrong settings[] = {
    {"film width 10", "1:1: 'film' needs 'height PIXELS'"},
    {"film width 10 height", "1:21: the statement ends before all of 'height PIXELS' was there"},
    {"film width height 10", "1:19: '10' is no word of 'film'; it must be one of: width, height"},
    {"film width 10 hieght 10", "1:15: 'hieght' is no word of 'film'; did you mean 'height'?"},
    {"film width 10 height 10 width 10", "1:25: 'width' stands in this statement twice"},
    {"film width 0 height 10", "1:12: width is 0, it must be from 1 to 16384"},
    {"film width 1.5 height 10", "1:12: width is 1.5, it must be a whole number"},
    {"film width nan height 10", "1:12: 'nan' is no number; it must be 'width PIXELS'"},
    {"film width 0x10 height 10", "1:12: '0x10' is no number"},
    {"film width 16384 height 16384", "1:12: 16384 x 16384 pixels are more than"},
    {"camera from 0 0 1 to 0 0", "1:25: the statement ends before all of 'to X Y Z' was there"},
    {"camera from 0 0 1 to 0\n  0 z", "2:5: 'z' is no number; it must be 'to X Y Z'"},
    {"camera from 0 0 1 to 0 0 1", "1:19: the camera looks nowhere"},
    {"camera from 0 1 0 to 0 0 0", "1:19: the camera looks along 'up'"},
    {"camera from 0 0 1 to 0 0 0 up 0 0 0", "1:28: the camera looks along 'up'"},
    {"camera from 0 0 2e6 to 0 0 0", "1:17: from is 2000000, it must be from -1000000 to 1000000"},
    {"camera from 0 0 1 to 0 0 0 field 180", "1:34: field is 180, it must be from 1 to 170"},
    {"integrator depth 0", "1:18: depth is 0, it must be from 1"},
    {"integrator roulette 0", "1:21: roulette is 0"},
    {"integrator samples -1", "1:20: samples is -1"},
    {"integrator exposure 0", "1:21: exposure is 0"},
    {"environment", "1:1: 'environment' needs 'constant R G B' or 'image NAME'"},
    {"environment constant 1 1 -1", "1:26: constant is -1"},
    {"environment constant 1 1 1 turn 3", "1:28: 'turn' is of an image, and this statement has none"},
    {"environment image sky", "1:19: no image is defined before this, so 'sky' is none"},
    {"image sky pattern stars width 4 height 4\nenvironment image sk",
     "2:19: 'sk' is no image that is defined before"},
    {"image", "1:1: 'image' needs a name, as in 'image sky file sky.pfm'"},
    {"image \"\" pattern stars", "1:7: a name has 1 to 64 letters"},
    {"image sky", "1:1: 'image' needs one of 'file PATH' and 'pattern NAME'"},
    {"image sky file a.pfm pattern stars", "1:1: 'image' needs one of"},
    {"image sky pattern star", "1:19: there is no pattern 'star'; did you mean 'stars'?"},
    {"image sky file a.pfm width 3", "1:22: 'width' is of a pattern; a file has its own"},
    {"image sky file \"\"", "1:16: a path is empty"},
    {"image sky file none.pfm", "1:16: " VNDF_SOURCE_DIR "/tests/none.pfm: "},
    {"image sky file test.h", "1:16: " VNDF_SOURCE_DIR "/tests/test.h: this is no PFM image"},
    {"image a pattern ramp\nimage a pattern ramp", "2:7: there is an image 'a' already"},
    {"image a pattern ramp width 16384 height 16384", "1:17: 16384 x 16384 pixels are more than"},
};

/* In line 3, behind a camera and light. */
static const wrong materials[] = {
    {"material", "3:1: 'material' needs a name"},
    {"material a", "3:10: what 'a' is must stand here"},
    {"material a conducter", "3:12: 'conducter' is no choice for 'material'; did you mean 'conductor'?"},
    {"material a matte", "3:12: 'matte' needs 'colour R G B'"},
    {"material a matte colour 1 1 2", "3:29: colour is 2, it must be from 0 to 1"},
    {"material a matte color 1 1 1", "3:18: 'color' is no word of 'material'; did you mean 'colour'?"},
    {"material a matte colour 1 1 1 index 2",
     "3:31: 'index' does not go with 'matte'; it goes with: dielectric,"},
    {"material a matte colour 1 1 1\nmaterial a mirror", "4:10: there is a material 'a' already"},
    {"material a matte colour 1 1 1 colour-map b", "3:42: no image is defined before this"},
    {"material a light", "3:12: 'light' needs 'radiance R G B'"},
    {"material a glass", "3:12: 'glass' needs 'index N'"},
    {"material a glass index 0", "3:24: index is 0"},
    {"material a dielectric index 1.5 alpha 1", "3:12: 'dielectric' needs 'distribution ggx|"},
    {"material a dielectric index 1.5 distribution ggx",
     "3:33: 'distribution ggx' needs 'alpha A' or 'alpha AX AY'"},
    {"material a dielectric index 1.5 distribution gxx",
     "3:46: 'gxx' is no choice for 'distribution'; did you mean 'ggx'?"},
    {"material a dielectric index 1.5 distribution ggx 2 alpha 1", "3:50: 'distribution ggx' takes nothing more"},
    {"material a dielectric index 1.5 distribution table", "3:46: 'distribution table' needs a file"},
    {"material a dielectric index 1.5 distribution table x.vndf", "3:52: "},
    {"material a shape distribution family gggx", "3:38: "},
    {"material a shape distribution slope \"exp(-r\"", "3:37: "},
    {"material a shape distribution slope \"r-1\"", "3:37: "},
    {"material a shape distribution ggx alpha 1 bytes 4096", "3:43: 'bytes' is of tables that are made here"},
    {"material a shape distribution family ggx bytes 1", "3:48: bytes is 1, it must be from 2048"},
    {"material a shape distribution ggx alpha 0", "3:41: alpha is 0, it must be from"},
    {"material a shape distribution ggx alpha 1 x", "3:43: 'x' is no number; it must be 'alpha A or AX AY'"},
    {"material a shape distribution ggx alpha 1 1 1", "3:45: '1' is no word of 'material'"},
    {"material a conductor distribution ggx alpha 1", "3:12: 'conductor' needs 'of METAL', or 'eta R G B'"},
    {"material a conductor of tin distribution ggx alpha 1",
     "3:25: 'tin' is no choice for 'of'; it must be one of: gold"},
    {"material a conductor of gold k 1 1 1 distribution ggx alpha 1", "3:22: 'of' names a metal"},
    {"material a conductor eta 0 1 1 k 0 1 1 distribution ggx alpha 1",
     "3:10: conductor_eta[0] and conductor_k[0]"},
    {"material a reflector f0 0 0 0 lobes both distribution ggx alpha 1", "3:31: 'lobes both' needs 'index N'"},
    {"material a shape lobes both index 2 distribution ggx alpha 1",
     "3:10: effects: lobes is both and fresnel is none: nothing says"},
    {"material a dielectric index 2 normals bounded distribution ggx alpha 1",
     "3:10: effects: normals is bounded, normals that reflect to above the horizon: lobes must be reflection"},
    {"material a dielectric index 2 lobes reflection absorb 1 1 1 distribution ggx alpha 1",
     "3:48: 'absorb' is of what light passes"},
    {"material a shape distribution ggx alpha 1 order 3", "3:43: 'order' goes with 'scattering multiple'"},
    {"material a shape distribution ggx alpha 1 masking v-cavites",
     "3:51: 'v-cavites' is no choice for 'masking'; did you mean 'v-cavities'?"},
    {"material a shape distribution ggx alpha 1 rotation 361", "3:52: rotation is 361"},
    {"image m pattern ramp\nmaterial a shape distribution ggx alpha 1 alpha-map m alpha-x-map m",
     "4:43: 'alpha-map' is"},
};

static const wrong shapes[] = {
    {"sphere centre 0 0 0 radius 1", "3:1: 'sphere' needs 'material NAME'"},
    {"sphere centre 0 0 0 radius 0 material m", "3:28: radius is 0, it must be from"},
    {"sphere centre 0 0 0 radius 1 material m", "3:39: no material is defined before this, so 'm' is none"},
    {"material mm mirror\nsphere centre 0 0 0 radius 1 material m",
     "4:39: 'm' is no material that is defined before"},
    {"rectangle corner 0 0 0 edge-u 1 0 0 edge-v 1 1 0 material m",
     "3:37: the edges of a rectangle must be at right angles; these are at 45 degrees"},
    {"rectangle corner 0 0 0 edge-u 0 0 0 edge-v 1 1 0 material m", "3:24: 'edge-u' has no length"},
    {"rectangle corner 0 0 0 edge-u 1 0 0 edge-v 0 0 0 material m", "3:37: 'edge-v' has no length"},
    {"box from 0 0 0 to 1 0 1 material m", "3:34: no material"},
    {"material m mirror\nbox from 0 0 0 to 1 0 1 material m", "4:16: the box is flat"},
    {"mesh file x.obj scale 0 material m", "3:23: scale is 0"},
    {"mesh material m", "3:1: 'mesh' needs 'file PATH'"},
    {"material m mirror\nmesh file none.obj material m", "4:11: "},
};

static void test_refusals(void)
{
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        refused("", &words[i]);
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
        refused("", &settings[i]);
    for (size_t i = 0; i < sizeof materials / sizeof materials[0]; i++)
        refused(LIT, &materials[i]);
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++)
        refused(LIT, &shapes[i]);
}

static void test_bytes(void)
{
    scene s;
    char message[MESSAGE], zero[] = "title a\n\0", tiny[8];
    TEST(!scene_read_text(&s, "z", zero, sizeof zero - 1, message, sizeof message));
    TEST_HAS(message, "z:2:1: a byte 0");
    TEST(!scene_read_text(&s, "a long name", zero, 8, tiny, sizeof tiny)); /* cut, not overrun */
    TEST(!scene_read(&s, VNDF_SOURCE_DIR "/tests/none.scene", message, sizeof message));
    TEST_HAS(message, "none.scene:1:1: ");
}

/* ---- what is shipped ---- */

static void test_shipped(void)
{
    static const char *const names[] = {"plate", "glass", "metal", "textured", "spheres", "rings", "furnace"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        scene s;
        char path[512], message[MESSAGE];
        snprintf(path, sizeof path, "%s/tools/scenes/%s.scene", VNDF_SOURCE_DIR, names[i]);
        if (!TEST(scene_read(&s, path, message, sizeof message))) {
            fprintf(stderr, "%s\n", message);
            continue;
        }
        TEST(s.title != NULL && s.geometry.shape_count > 0);
        scene_free(&s);
    }
}

/* Every word that the reader knows stands in the grammar. */
static void test_grammar(void)
{
    static const char *const known[] = {
        "title", "film", "camera", "integrator", "environment", "image", "material", "sphere", "rectangle",
        "box", "mesh", "conductor", "dielectric", "reflector", "shape", "matte", "mirror", "glass", "light",
        "alpha-x-map", "alpha-y-map", "alpha-map", "colour-map", "absorb", "order", "scattering", "masking", "rotation", "bytes"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        TEST_HAS(scene_grammar, known[i]);
}

int main(void)
{
    test_settings();
    test_defaults();
    test_rough_materials();
    test_plain_materials();
    test_shapes();
    test_refusals();
    test_bytes();
    test_shipped();
    test_grammar();
    return test_done();
}
