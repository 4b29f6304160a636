/* vndf eval: a filter. A normal wm.x,wm.y,wm.z per line of stdin gives ndf,pdf,lambda,g1 on stdout. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/output.h"
#include "cli/surface.h"

static const char name[] = "vndf eval";

static const char help[] =
    "usage: vndf eval " SURFACE_POSITIONAL " --theta DEG [--phi DEG] [--alpha AX[,AY]]\n"
    "       vndf eval --lobe 'KEY=VALUE ...' [--lobe ...] --theta DEG [--phi DEG]\n"
    "\n"
    "Reads one normal a line from stdin, wm.x,wm.y,wm.z (unit within 1e-3; no header), and prints a line for each:\n"
    "\n"
    "  ndf,pdf,lambda,g1\n"
    "\n"
    "  ndf     D(wm) per steradian\n"
    "  pdf     density per steradian with which `vndf sample` draws wm from this incident direction\n"
    "  lambda  Smith's Lambda of the incident direction\n"
    "  g1      Smith's masking of the incident direction, 1/(1 + lambda); 0 below the horizon\n"
    "\n"
    "  --theta DEG      angle of the incident direction from the normal, 0 to 180\n"
    "  --phi DEG        its azimuth from the x axis, -360 to 360 (default 0)\n"
    "  --alpha AX[,AY]  roughness along x and y (default 1)\n"
    "\n" SURFACE_HELP "\n"
    "Then all four numbers are of the whole surface. Where lobes have mean slopes, the mean plane of the whole stands\n"
    "for the horizon in lambda and g1.\n"
    "\n"
    "example: echo 0.6,0,0.8 | vndf eval ggx --theta 45 --alpha 0.5\n"
    "         echo 0.6,0,0.8 | vndf eval --theta 45 --lobe 'weight=0.7 table=ggx alpha=0.1,0.2 mean=0.1,0' \\\n"
    "                                    --lobe 'weight=0.3 table=beckmann matrix=0.5,0.2,-0.1,0.4'\n";

enum { LINE_MAX_LENGTH = 256 };

/* Without the line's end. 1, or 0 after a complaint. */
static int trim_line(char *line, unsigned long long number)
{
    size_t length = strlen(line);
    if (length + 1 == LINE_MAX_LENGTH && line[length - 1] != '\n') {
        complain(name, "stdin, line %llu: longer than %d characters", number, LINE_MAX_LENGTH - 2);
        return 0;
    }
    while (length && (line[length - 1] == '\n' || line[length - 1] == '\r'))
        line[--length] = '\0';
    return 1;
}

/* Normalised, so that nine digits of a text file are as good as the float. 1, or 0 after a complaint. */
static int read_normal(const char *line, unsigned long long number, vndf_vec3 *wm)
{
    char where[48];
    double v[3];
    snprintf(where, sizeof where, "stdin, line %llu:", number);
    if (!parse_numbers(name, where, line, -2, 2, 3, 3, v)) {
        complain(name, "a line has to be wm.x,wm.y,wm.z, a unit vector");
        return 0;
    }
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (fabs(length - 1) > 1e-3) {
        complain(name, "%s '%s' has length %.6g; a normal has length 1 within 1e-3", where, line, length);
        return 0;
    }
    *wm = (vndf_vec3){(float)(v[0] / length), (float)(v[1] / length), (float)(v[2] / length)};
    return 1;
}

static int evaluate_lines(const chosen_surface *surface)
{
    char line[LINE_MAX_LENGTH];
    vndf_mixture_view view = vndf_mixture_view_from(&surface->mixture, surface->wi);
    double lambda = (double)surface_lambda(surface), g1 = (double)surface_g1(surface);
    for (unsigned long long number = 1; fgets(line, sizeof line, stdin); number++) {
        vndf_vec3 wm;
        if (!trim_line(line, number) || !read_normal(line, number, &wm))
            return STATUS_USE;
        double ndf = (double)surface_ndf(surface, wm), pdf = (double)vndf_mixture_pdf(&view, wm);
        if (printf("%.9g,%.9g,%.9g,%.9g\n", ndf, pdf, lambda, g1) < 0)
            return STATUS_USE; /* main says why */
    }
    if (ferror(stdin))
        return complain(name, "cannot read stdin: %s", strerror(errno));
    return STATUS_GOOD;
}

int command_eval(int argc, char **argv)
{
    aim_words aim = {0};
    words positional = {{NULL}, 0};
    chosen_surface surface;
    const option_form options[] = {{"--theta", 1, 1, &aim.theta},
                                   {"--phi", 1, 1, &aim.phi},
                                   {"--alpha", 1, 1, &aim.alpha},
                                   {"--lobe", 1, VNDF_MIXTURE_LOBES, &aim.lobes}};
    const command_form form = {name, help, options, sizeof options / sizeof options[0], SURFACE_POSITIONAL, 0, 1};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    if (parsed != PARSE_GO_ON)
        return parsed;
    if (!surface_open(&surface, name, &aim, &positional))
        return STATUS_USE;
    int status = input_stdin(name) ? evaluate_lines(&surface) : STATUS_USE;
    surface_close(&surface);
    return status;
}
