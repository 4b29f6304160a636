#include "commands/parts/albedo_print.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "cli/output.h"
#include "cli/subject.h"
#include "draw/table.h"

static int sides_of(const vndf_albedo *albedo)
{
    return vndf_albedo_info(albedo).eta > 0 ? 2 : 1;
}

/* What vndf_albedo.h takes for the side of z and the other one. */
static float sign_of(int side)
{
    return side ? -1.0f : 1.0f;
}

static float cosine_of(double theta, int side)
{
    return sign_of(side) * direction_from(theta, 0).z;
}

/* ---- text ---------------------------------------------------------------------------------------- */

static void print_heading(FILE *file, const char *what, int side, int sides, const albedo_lists *at)
{
    fprintf(file, "\n%s%s\n%7s", what,
            sides == 1 ? ""
            : side     ? ", from the other side"
                       : ", from the side of z",
            "theta");
    for (size_t j = 0; j < at->alphas; j++)
        fprintf(file, "  a=%-6.4g", at->alpha[j]);
    fputc('\n', file);
}

static void print_side(FILE *file, const vndf_albedo *albedo, const albedo_lists *at, int side)
{
    print_heading(file, "albedo", side, sides_of(albedo), at);
    for (size_t i = 0; i < at->thetas; i++) {
        fprintf(file, "%7g", at->theta[i]);
        for (size_t j = 0; j < at->alphas; j++)
            fprintf(file, " %9.5f",
                    (double)vndf_albedo_directional(albedo, cosine_of(at->theta[i], side), (float)at->alpha[j]));
        fputc('\n', file);
    }
    fputs("average", file);
    for (size_t j = 0; j < at->alphas; j++)
        fprintf(file, " %9.5f", (double)vndf_albedo_average(albedo, (float)at->alpha[j], side ? -1 : 1));
    fputc('\n', file);
}

static void print_transmitted(FILE *file, const vndf_albedo *albedo, const albedo_lists *at, int side)
{
    print_heading(file, "transmitted part", side, 2, at);
    for (size_t i = 0; i < at->thetas; i++) {
        fprintf(file, "%7g", at->theta[i]);
        for (size_t j = 0; j < at->alphas; j++) {
            float cosine = cosine_of(at->theta[i], side);
            fprintf(file, " %9.5f", (double)vndf_albedo_split(albedo, cosine, (float)at->alpha[j]).transmitted);
        }
        fputc('\n', file);
    }
    fputs("average", file);
    for (size_t j = 0; j < at->alphas; j++)
        fprintf(file, " %9.5f",
                (double)vndf_albedo_average_split(albedo, (float)at->alpha[j], side ? -1 : 1).transmitted);
    fputc('\n', file);
}

void albedo_print_facts(FILE *file, const vndf_albedo_properties *is)
{
    fprintf(file,
            "error %.2g (cosine %.3g, alpha %.3g)\nerror_usual %.2g (alpha 0.05 to 1)\nsplit_error %.2g\n"
            "split_usual %.2g\naverage_error %.2g\nquadrature_error %.2g\ngrid %d cosines, %d alphas\nvalues %lu\n"
            "bytes %lu\n",
            (double)is->error, (double)is->error_cosine, (double)is->error_alpha, (double)is->error_usual,
            (double)is->split_error, (double)is->split_usual, (double)is->average_error,
            (double)is->quadrature_error, is->columns, is->rows, (unsigned long)is->values,
            (unsigned long)is->bytes);
}

void albedo_print_text(FILE *file, const char *subject, const vndf_albedo *albedo, const albedo_lists *at)
{
    vndf_albedo_properties is = vndf_albedo_info(albedo);
    if (is.eta > 0)
        fprintf(file, "%s, dielectric, eta %g\n", subject, (double)is.eta);
    else
        fprintf(file, "%s, mirror\n", subject);
    for (int side = 0; side < sides_of(albedo); side++) {
        print_side(file, albedo, at, side);
        if (is.eta > 0)
            print_transmitted(file, albedo, at, side);
    }
    fputc('\n', file);
    albedo_print_facts(file, &is);
}

/* ---- CSV ----------------------------------------------------------------------------------------- */

void albedo_print_csv(FILE *file, const char *subject, const vndf_albedo *albedo, const albedo_lists *at)
{
    double eta = (double)vndf_albedo_info(albedo).eta;
    fputs("distribution,eta,side,alpha,theta,albedo,reflected,transmitted,average\n", file);
    for (int side = 0; side < sides_of(albedo); side++)
        for (size_t j = 0; j < at->alphas; j++)
            for (size_t i = 0; i < at->thetas; i++) {
                float cosine = cosine_of(at->theta[i], side), alpha = (float)at->alpha[j];
                vndf_albedo_parts parts = vndf_albedo_split(albedo, cosine, alpha);
                table_quote(file, subject);
                fprintf(file, ",%.9g,%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", eta, side ? -1 : 1, at->alpha[j],
                        at->theta[i], (double)vndf_albedo_directional(albedo, cosine, alpha),
                        (double)parts.reflected, (double)parts.transmitted,
                        (double)vndf_albedo_average(albedo, alpha, side ? -1 : 1));
            }
}

/* ---- C ------------------------------------------------------------------------------------------- */

enum { IDENTIFIER = 64 };

/* "out/rough-gold.h" gives rough_gold. */
static void identifier_of(const char *path, char name[IDENTIFIER])
{
    const char *slash = strrchr(path, '/'), *begin = slash ? slash + 1 : path;
    size_t n = 0;
    if (output_is_stdout(path))
        begin = "albedo";
    if (!isalpha((unsigned char)*begin))
        name[n++] = '_';
    for (; *begin && *begin != '.' && n < IDENTIFIER - 1; begin++)
        name[n++] = (char)(isalnum((unsigned char)*begin) ? *begin : '_');
    name[n] = '\0';
}

/* Inside of a comment. */
static void print_remark(FILE *file, const char *text)
{
    for (; *text; text++) {
        fputc(*text, file);
        if (text[0] == '*' && text[1] == '/')
            fputc(' ', file);
    }
}

static void print_numbers(FILE *file, const float *values, int count, const char *indent)
{
    enum { ON_A_LINE = 8 };
    for (int i = 0; i < count; i++)
        fprintf(file, "%s%.6ff%s", i % ON_A_LINE ? " " : indent, (double)values[i],
                i == count - 1                   ? "\n"
                : i % ON_A_LINE == ON_A_LINE - 1 ? ",\n"
                                                 : ",");
}

static void print_arrays(FILE *file, const char *name, const vndf_albedo *albedo, int size, int side)
{
    enum { MOST = 256 };
    float values[MOST], step = 1.0f / (float)(size - 1);
    fprintf(file, "static const float %s%s[%d][%d] = {\n", name, side ? "_other_side" : "", size, size);
    for (int i = 0; i < size; i++) {
        float roughness = (float)i * step, alpha = roughness * roughness;
        for (int j = 0; j < size; j++) /* -0 is the side of z */
            values[j] = vndf_albedo_directional(albedo, sign_of(side) * (j ? (float)j * step : 1e-30f), alpha);
        fputs("    {\n", file);
        print_numbers(file, values, size, "        ");
        fputs(i == size - 1 ? "    }\n};\n" : "    },\n", file);
    }
    for (int i = 0; i < size; i++) {
        float roughness = (float)i * step;
        values[i] = vndf_albedo_average(albedo, roughness * roughness, side ? -1 : 1);
    }
    fprintf(file, "static const float %s%s_average[%d] = {\n", name, side ? "_other_side" : "", size);
    print_numbers(file, values, size, "    ");
    fputs("};\n", file);
}

void albedo_print_c(FILE *file, const char *path, const vndf_albedo *albedo, int size)
{
    vndf_albedo_properties is = vndf_albedo_info(albedo);
    char name[IDENTIFIER];
    identifier_of(path, name);
    fprintf(
        file,
        "/* Directional albedo of single scattering with height-correlated Smith masking, made by `vndf albedo` of\n"
        " * vndf " VNDF_VERSION ". The distribution: ");
    print_remark(file, is.source);
    if (is.eta > 0)
        fprintf(file, "\n * A dielectric, eta %.9g: what is reflected and transmitted together.", (double)is.eta);
    else
        fputs("\n * A mirror, F = 1.", file);
    fprintf(file,
            "\n *\n"
            " * %s[i][j]: perceptual roughness sqrt(alpha) = i/%d, cosine of incidence j/%d. alpha = 1 is the\n"
            " * distribution as it was given. %s_average[i] = 2 integral E mu dmu.\n"
            " * Within %.1g of quadrature (alpha 0.05 to 1). Between the entries E is not linear: near cosine 0\n"
            " * it changes where the cosine is of the size of alpha. */\n",
            name, size - 1, size - 1, name, (double)is.error_usual);
    if (is.eta > 0)
        fprintf(file, "/* %s_other_side: the same from the other side of the surface. */\n", name);
    for (int side = 0; side < sides_of(albedo); side++)
        print_arrays(file, name, albedo, size, side);
}
