/* `vndf export` writes one file for every language, with the calls that are asked for and no others, all names with the
 * prefix, numbers in it or beside it. It notices a call that is lost or comes along, a name without its prefix, and
 * numbers that are lost. */
#include "harness/run_program.h"

#define TABLE(name) VNDF_SOURCE_DIR "/tables/" name ".vndf"
#define SMALL TABLE("student-t-2.5-small")
#define TWO SMALL " " TABLE("student-t-2.5")

static const char *const languages[] = {"c", "cpp", "cuda", "opencl", "glsl", "hlsl", "wgsl", "msl", NULL};

/* Texts between bars. */
static const struct {
    const char *words, *has, *lacks;
} files[] = {
    {SMALL,
     "VNDF_STUDENT_T_2_5_SMALL, |--family student-t:2.5\n|above the horizon|VNDF_GGX|VNDF_LOBES|VNDF_NUMBERS|"
     "vndf_sample(|vndf_pdf(|vndf_visible(|vndf_ndf(|vndf_lambda(|vndf_g1(|vndf_g2(|vndf_projected_area(|"
     "vndf_mixture_sample(|vndf_bounded_sample(|vndf_bounded_pdf(",
     "vndf_family_at("},
    {TABLE("hazy"), "VNDF_HAZY", "vndf_family_at("}, /* of the default size */
    {"tails.vndfs --buffer two.f32", "VNDF_TAILS|parameters from 2 to 4|vndf_family_at(", "vndf_bsdf_sample("},
    {SMALL " --only view,sample", "vndf_rough(|vndf_view_from(|vndf_sample(",
     "vndf_pdf(|vndf_table_pdf(|vndf_mixture_pdf("},
    {SMALL " --bsdf both --fresnel dielectric",
     "lobes=both fresnel=dielectric masking=correlated|vndf_bsdf_sample(|vndf_bsdf_eval(|vndf_bsdf_pdf(|"
     "vndf_bsdf_cosine(|vndf_dielectric(|vndf_beta_of(|vndf_refracted_at(",
     "vndf_conductor(|vndf_schlick(|vndf_masked_apart(|vndf_mixture_pdf(|vndf_g2("},
    {SMALL " --bsdf reflection --masking none --only bsdf_eval", "vndf_bsdf_eval(",
     "vndf_bsdf_sample(|vndf_bsdf_pdf(|vndf_refracting(|vndf_ggx_draw(|vndf_masked_by_height("},
    {TWO " --buffer two.f32 --prefix my_d --lobes 2",
     "MY_D_STUDENT_T_2_5, |MY_D_STUDENT_T_2_5_SMALL|my_d_sample(|MY_D_LOBES", "MY_D_NUMBERS|vndf_|VNDF_"},
};

/* Whether the text has each of these parts, or none of them. */
static void expect(const char *text, const char *parts, int there, const char *language)
{
    char part[80];
    for (; *parts; parts += strlen(part), parts += *parts == '|') {
        snprintf(part, sizeof part, "%.*s", (int)strcspn(parts, "|"), parts);
        if (!TEST((strstr(text, part) != NULL) == there))
            fprintf(stderr, "  '%s' in %s\n", part, language);
    }
}

/* The text of a file in a language, until the next is asked for. */
static const char *exported(const char *words, const char *language)
{
    static char *text;
    size_t size;
    run_line(0, "", "vndf export %s --language %s -o out", words, language);
    free(text);
    text = run_file("out", &size);
    return TEST(text && remove("out") == 0) ? text : "";
}

int main(void)
{
    char folder[] = "export.XXXXXX", line[512];
    size_t count = sizeof files / sizeof *files, first, second, size;
    if (!run_begin(folder))
        return test_done();
    run_line(2, "which is taken", "cp '" SMALL "' lobes.vndf && vndf export lobes.vndf --language c -o x");
    run_line(0, "", "vndf build --family student-t --parameter 2..4 --max-tv 0.05 -o tails.vndfs");
    for (size_t i = 0; i < count; i++)
        for (const char *const *to = languages; *to; to++) {
            const char *text = exported(files[i].words, *to);
            expect(text, files[i].has, 1, *to);
            expect(text, files[i].lacks, 0, *to);
            expect(text, " surface_of(|(table_at(| table_at(|(frame_of(| frame_of(", 0, *to);
        }
    /* The raw file has as many numbers as the comments say, and where the second table begins. */
    const char *text = exported(files[count - 1].words, "c"), *at = strstr(text, "// MY_D_STUDENT_T_2_5");
    if (TEST(at && sscanf(strchr(at, ','), ", %zu", &first) == 1 &&
             sscanf(strchr(strchr(at, '\n'), ','), ", %zu", &second) == 1)) {
        snprintf(line, sizeof line, "MY_D_STUDENT_T_2_5 = %zu |MY_D_LOBES = 2 |const float *numbers", first);
        expect(text, line, 1, "c");
        free(run_file("two.f32", &size));
        TEST(size == 4 * (first + second));
    }
    TEST(remove("two.f32") == 0 && remove("tails.vndfs") == 0 && remove("lobes.vndf") == 0);
    return run_end(folder);
}
