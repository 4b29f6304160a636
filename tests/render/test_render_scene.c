/* A scene file becomes what it says, every statement and clause of it; the scenes that are shipped are good,
 * and so is the example of the help. */
#include "harness/test.h"

#include "render/film.h"
#include "render/scene_text.h"

static const material *material_of(const scene *s, const char *name)
{
    for (size_t i = 0; i < s->material_count; i++)
        if (strcmp(s->materials[i].name, name) == 0)
            return &s->materials[i];
    fprintf(stderr, "there is no material '%s'\n", name);
    TEST(0);
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
    TEST(m && m->is.effects.shape == VNDF_SHAPE_ROTATED && m->is.effects.normals == VNDF_NORMALS_ALL);
    TEST_NEAR(m ? (double)m->is.rotation : 0.0, 0.78539816339, 1e-6);
    m = material_of(s, "e");
    TEST(m && m->is.effects.fresnel == VNDF_FRESNEL_NONE && m->is.effects.masking == VNDF_MASKING_SEPARABLE);
}

static void test_rough_materials(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s,
                        LIT
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
        vndf_material made;
        TEST(s.materials[i].kind == MATERIAL_MICROFACET && !s.materials[i].is_textured);
        TEST(vndf_material_resolve(&s.materials[i].is, &made, NULL) == VNDF_OK);
    }
    scene_free(&s);
}

/* ---- lobes ---- */

static void check_slopes(const scene *s)
{
    const material *m = material_of(s, "a"), *b = material_of(s, "b"), *c = material_of(s, "c");
    TEST(m && m->lobe_count == 1 && m->is.effects.shape == VNDF_SHAPE_MATRIX && m->lobes[0].is_matrix);
    TEST(m && m->is.affine.xx == 0.3f && m->is.affine.xy == 0.1f && m->is.affine.yx == -0.1f &&
         m->is.affine.yy == 0.2f && m->is.effects.reflection == VNDF_REFLECTION_RETRO);
    TEST(b && b->lobe_count == 1 && b->is.effects.shape == VNDF_SHAPE_AFFINE && b->is.affine.mean_x == -0.5f &&
         b->is.affine.mean_y == 0.25f);
    TEST_NEAR(b ? (double)b->is.affine.xy : 0.0, -0.4, 1e-6); /* a quarter of a turn: y to -x */
    TEST_NEAR(b ? (double)b->is.affine.yx : 0.0, 0.2, 1e-6);
    TEST(b && b->lobes[0].alpha_y.map == &s->images[0] && b->is.distribution == vndf_beckmann());
    TEST(c && c->is.effects.shape == VNDF_SHAPE_AFFINE && c->lobes[0].relief == s->reliefs[0]);
    TEST(s->reliefs[0]->first.width == 4 && s->reliefs[0]->second.width == 4);
    c = material_of(s, "d");
    TEST(c && c->lobes[0].relief == s->reliefs[1] && !s->reliefs[1]->second.rgb && c->lobe_count == 1);
    TEST(s->reliefs[1]->first.width == 8 && s->reliefs[1]->steepest == 0.0f);
}

static void check_mixtures(const scene *s)
{
    const material *m = material_of(s, "e");
    TEST(m && m->lobe_count == 3 && m->is.effects.shape == VNDF_SHAPE_MIXTURE && m->is.distribution == vndf_ggx());
    TEST(m && m->lobes[0].weight.value == 1.0f && m->lobes[1].weight.value == 0.3f &&
         m->lobes[1].weight.map == &s->images[0] && m->lobes[1].distribution == s->tables[0]);
    TEST(m && m->lobes[2].alpha_x.value == m->lobes[0].alpha_x.value && m->lobes[1].mean_x == 0.1f);
    m = material_of(s, "f"); /* one lobe that does not lean: a matrix */
    TEST(m && m->lobe_count == 1 && m->is.effects.shape == VNDF_SHAPE_MATRIX);
}

static void test_lobes(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(
            &s,
            LIT "image m pattern ramp width 8 height 8\nimage n file corpus/pfm/upright\n"
                "material a conductor of gold distribution ggx matrix 0.3 0.1 -0.1 0.2 retroreflective\n"
                "material b dielectric index 1.5 distribution beckmann alpha 0.2 0.4 alpha-y-map m\n"
                "  rotation 90 mean -0.5 0.25\n"
                "material c shape height-map m scale 0.1 0.2 filtered 2 distribution ggx alpha 0.1\n"
                "material d shape normal-map n distribution ggx matrix 1 0 0 1\n"
                "lobe core distribution ggx alpha 0.1\n"
                "lobe haze distribution table ../tables/hazy.vndf alpha 0.4 weight 0.3 weight-map m mean 0.1 0\n"
                "material e conductor of gold mix core haze core masking separable\n"
                "material f conductor of gold mix core\n",
            message))) {
        fprintf(stderr, "%s\n", message);
        return;
    }
    check_slopes(&s);
    check_mixtures(&s);
    for (size_t i = 0; i < s.material_count; i++) {
        vndf_material made;
        TEST(vndf_material_resolve(&s.materials[i].is, &made, NULL) == VNDF_OK);
    }
    scene_free(&s);
}

static void check_families(const scene *s)
{
    const material *a = material_of(s, "a"), *b = material_of(s, "b"), *c = material_of(s, "c");
    TEST(s->family_count == 1 && s->table_count == 0);
    TEST(a && a->lobe_count == 1 && a->is.effects.shape == VNDF_SHAPE_MIXTURE && !a->lobes[0].parameter.map);
    TEST(a && a->lobes[0].family == s->families[0] && a->lobes[0].parameter.from == 2.5f &&
         a->lobes[0].alpha_x.value == 1.0f);
    TEST(a && a->is.distribution == vndf_family_distribution(s->families[0], 1)); /* 3 is nearer than 1.8 */
    TEST(b && b->lobes[0].parameter.from == 3.0f && b->lobes[0].parameter.to == 1.8f &&
         b->lobes[0].parameter.map == &s->images[0] && b->lobes[0].is_matrix);
    TEST(c && c->lobe_count == 2 && c->lobes[0].family == s->families[0] && !c->lobes[1].family);
}

static void test_families(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s,
                        LIT "image m pattern ramp width 8 height 8\n"
                            "material a shape distribution family corpus/family/two.vndfs parameter 2.5\n"
                            "material b shape distribution family corpus/family/two.vndfs parameter 3 1.8\n"
                            "  parameter-map m matrix 1 0 0.5 1 mean 0.1 0\n"
                            "lobe tail distribution family corpus/family/two.vndfs parameter 3 alpha-map m\n"
                            "lobe core distribution ggx alpha 0.1\nmaterial c shape mix tail core\n",
                        message))) {
        fprintf(stderr, "%s\n", message);
        return;
    }
    check_families(&s);
    scene_free(&s);
}

/* Albedos are made later; what else the library asks is asked at once. */
static void test_compensation(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s,
                        LIT "material a shape distribution ggx alpha 1 scattering turquin\n"
                            "material b dielectric index 1.5 distribution ggx alpha 1 scattering kulla-conty\n"
                            "material c shape distribution ggx matrix 1 0 0.5 1 scattering kulla-conty\n",
                        message))) {
        fprintf(stderr, "%s\n", message);
        return;
    }
    const material *m = s.materials;
    TEST(m[0].is.effects.scattering == VNDF_SCATTERING_TURQUIN && !m[0].is.albedo && s.albedo_count == 0);
    TEST(m[1].is.effects.scattering == VNDF_SCATTERING_KULLA_CONTY && m[2].is.effects.shape == VNDF_SHAPE_MATRIX);
    scene_free(&s);
}

static void test_heights(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s,
                        LIT "image m pattern ramp width 8 height 4\nmaterial a mirror\nrectangle corner -1 -1 0 "
                            "edge-u 2 0 0 edge-v 0 2 0 material a heights m height 0.5\n",
                        message)))
        return;
    TEST(s.geometry.triangle_count == 2 * 8 * 4 && s.geometry.rectangle_count == 0);
    scene_free(&s);
}

static void test_plain_materials(void)
{
    scene s;
    char message[MESSAGE];
    if (!TEST(read_text(&s,
                        LIT "image m pattern ramp\nimage n pattern noise width 16 height 16\n"
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
    if (!TEST(read_text(&s,
                        LIT "material radius matte colour 1 1 1\n" /* a name may be a keyword */
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

/* The film keeps its shape, and its limits. */
static void test_resize(void)
{
    scene s = {.width = 640, .height = 400};
    char message[MESSAGE] = "";
    TEST(scene_resize(&s, 80, message, sizeof message) && s.width == 80 && s.height == 50);
    TEST(!scene_resize(&s, 16384, message, sizeof message) && s.width == 80 && s.height == 50);
    TEST_HAS(message, "a film of 80 x 50 pixels becomes 16384 x 10240: ");
    s.height = 1;
    TEST(!scene_resize(&s, 20, message, sizeof message));
    TEST_HAS(message, "becomes 20 x 0: it has 1 to 16384 rows");
}

/* ---- what is shipped ---- */

static void check_shipped(int good, scene *s, const char *message)
{
    if (!TEST(good)) {
        fprintf(stderr, "%s\n", message);
        return;
    }
    TEST(s->title != NULL && s->geometry.shape_count > 0);
    scene_free(s);
}

/* The table of rings is built as small as it can be, in half of the time. */
static void test_shipped(void)
{
    static const char *const names[] = {"plate",   "glass", "metal",        "textured", "rings",
                                        "furnace", "haze",  "compensation", "tails"};
    const scene_tables small = {.bytes = 2048};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        scene s;
        char path[512], message[MESSAGE];
        snprintf(path, sizeof path, "%s/tools/scenes/%s.scene", VNDF_SOURCE_DIR, names[i]);
        int good = scene_read_with(&s, path, &small, message, sizeof message);
        check_shipped(good, &s, message);
    }
}

/* The furnace that is shipped vanishes: every pixel is 1, but for what 16 weights of a table differ by, and their mean is
 * 1 within 1e-5 measured. */
static void test_furnace_vanishes(void)
{
    scene s;
    film f = {.sum = NULL};
    char message[MESSAGE];
    film_run run = {.samples = 16, .threads = 1};
    if (!TEST(scene_read(&s, VNDF_SOURCE_DIR "/tools/scenes/furnace.scene", message, sizeof message)))
        return;
    TEST(scene_resize(&s, 96, message, sizeof message));
    path_plan *plan = path_prepare(&s, SAMPLER_MATERIAL, 0, message, sizeof message);
    TEST(plan && film_make(&f, s.width, s.height) && film_render(&f, plan, &run) && !f.counts.samples_lost);
    size_t count = plan ? 3 * film_pixels(&f) : 0;
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        TEST_NEAR(f.sum[i] / 16, 1.0, 5e-2);
        sum += f.sum[i] / 16;
    }
    TEST_NEAR(sum / (double)count, 1.0, 5e-5);
    film_free(&f);
    path_free(plan);
    scene_free(&s);
}

static size_t read_file(const char *name, char *text, size_t size)
{
    char path[512];
    snprintf(path, sizeof path, "%s/tools/scenes/%s.scene", VNDF_SOURCE_DIR, name);
    FILE *file = fopen(path, "rb");
    size_t length = TEST(file != NULL) ? fread(text, 1, size - 1, file) : 0;
    if (file)
        fclose(file);
    text[length] = '\0';
    return length;
}

/* The spheres have the formula of the rings, which is not built again: a table that is shipped stands for it. */
static void test_shipped_spheres(void)
{
    enum { ROOM = 1 << 15 };
    static const char instead[] = "table ../../tables/hazy.vndf";
    static char text[ROOM], rings[ROOM];
    char message[MESSAGE];
    scene s;
    size_t length = read_file("spheres", text, ROOM);
    read_file("rings", rings, ROOM);
    for (char *at = text; (at = strstr(at, "bytes 4096")) != NULL;)
        memset(at, ' ', 10);
    for (char *at = text; (at = strstr(at, "slope \"")) != NULL;) {
        char *end = strchr(at + 7, '"'), formula[256];
        size_t letters = end ? (size_t)(end + 1 - at) : 0;
        if (!TEST(letters > sizeof instead && letters < sizeof formula))
            return;
        snprintf(formula, sizeof formula, "%.*s", (int)letters, at);
        TEST_HAS(rings, formula);
        memset(at, ' ', letters);
        memcpy(at, instead, sizeof instead - 1);
    }
    int good =
        scene_read_text(&s, VNDF_SOURCE_DIR "/tools/scenes/spheres.scene", text, length, message, sizeof message);
    check_shipped(good, &s, message);
}

/* The plate of heights and its mesh, both of 64 x 64 pixels here. */
static int read_small(const char *name, scene *made)
{
    enum { ROOM = 1 << 12 };
    char text[ROOM], message[MESSAGE] = "", path[512];
    size_t length = read_file(name, text, ROOM);
    snprintf(path, sizeof path, "%s/tools/scenes/%s.scene", VNDF_SOURCE_DIR, name);
    for (char *at = text; (at = strstr(at, "896")) != NULL;)
        memcpy(at, "064", 3);
    int good = scene_read_text(made, path, text, length, message, sizeof message);
    if (!TEST(good))
        fprintf(stderr, "%s\n", message);
    return good;
}

/* They show the same: triangles as steep as the map says, from the same eye. */
static void test_shipped_reliefs(void)
{
    scene flat, mesh;
    float steepest = 0.0f;
    if (!read_small("relief", &flat) || !read_small("relief-mesh", &mesh))
        return;
    TEST(mesh.geometry.triangle_count == 2 * 64 * 64 && flat.geometry.rectangle_count == 1);
    for (size_t i = 0; i < mesh.geometry.triangle_count; i++) {
        const vndf_vec3 *at = mesh.geometry.triangles[i].corner;
        vndf_vec3 n = cross(subtract(at[1], at[0]), subtract(at[2], at[0]));
        steepest = fmaxf(steepest, fmaxf(fabsf(n.x / n.y), fabsf(n.z / n.y)));
    }
    TEST(flat.relief_count == 1 && steepest > 0.01f);
    TEST_NEAR((double)(flat.reliefs[0]->steepest / steepest), 1.0, 1e-3);
    TEST(memcmp(&flat.camera, &mesh.camera, sizeof flat.camera) == 0 && flat.width == mesh.width);
    scene_free(&flat);
    scene_free(&mesh);
}

/* Every word that the reader knows stands in the grammar. */
static void test_grammar(void)
{
    static const char *const known[] = {
        "title",     "film",        "camera",    "integrator",    "environment", "image",       "material",
        "sphere",    "rectangle",   "box",       "mesh",          "conductor",   "dielectric",  "reflector",
        "shape",     "matte",       "mirror",    "glass",         "light",       "alpha-x-map", "alpha-y-map",
        "alpha-map", "colour-map",  "absorb",    "order",         "scattering",  "masking",     "rotation",
        "bytes",     "matrix",      "mean",      "height-map",    "filtered",    "normal-map",  "scale",
        "mix",       "lobe",        "weight",    "weight-map",    "heights",     "height",      "retroreflective",
        "turquin",   "kulla-conty", "parameter", "parameter-map", "family"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (!strstr(scene_grammar[0], known[i]) && !strstr(scene_grammar[1], known[i]))
            TEST_HAS(scene_grammar[2], known[i]);
}

/* Its lines stand two columns to the right there, in one piece. */
static void test_example(void)
{
    char text[1024], message[MESSAGE];
    size_t length = 0;
    scene s;
    const char *at = strstr(scene_grammar[0], "\n\n  "), *end = at ? strstr(at + 2, "\n\n") : NULL;
    if (!TEST(end != NULL && end - at < 1000))
        return;
    for (at++; at < end; at++) {
        text[length++] = *at;
        if (*at == '\n')
            at += 2;
    }
    text[length] = '\0';
    if (!TEST(read_text(&s, text, message))) {
        fprintf(stderr, "%s\n%s\n", message, text);
        return;
    }
    TEST(s.geometry.sphere_count == 1 && s.materials[0].is.effects.masking == VNDF_MASKING_SEPARABLE);
    scene_free(&s);
}

int main(void)
{
    test_settings();
    test_defaults();
    test_rough_materials();
    test_lobes();
    test_families();
    test_compensation();
    test_heights();
    test_plain_materials();
    test_shapes();
    test_resize();
    test_shipped();
    test_furnace_vanishes();
    test_shipped_spheres();
    test_shipped_reliefs();
    test_grammar();
    test_example();
    return test_done();
}
