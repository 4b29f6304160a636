#include "commands/parts/export_brdf.h"

#include <stdio.h>

#include "cli/output.h"
#include "cli/subject.h"
#include "command.h"
#include "measured/brdf.h"

const char brdf_help[] =
    "As reflectances, for hosts that read measured ones: what a surface of this D mirrors once, F by Schlick, masked\n"
    "by Smith with heights correlated. FILE is one table, ggx or beckmann.\n"
    "\n"
    "  --rgl            a .bsdf that Mitsuba 3 (plugin measured) renders as it is; with --wavelengths, its spectral\n"
    "                   variants and pbrt-v4\n"
    "  --alpha A        roughness (default 1, D as the table holds it)\n"
    "  --f0 R[,G,B]     reflectance at normal incidence, 0 to 1 (default 1: all light is reflected)\n"
    "  --wavelengths L,...   nanometres, ascending, up to 16; --f0 then has one number, or one for each\n"
    "\n"
    "example: vndf export tables/student-t-2.5.vndf --rgl --alpha 0.3 --f0 1,0.78,0.34 -o gold.bsdf\n";

/* ---- words --------------------------------------------------------------------------------------- */

/* Roughness, wavelengths, and F0: one number for all channels, or one for each. */
static int read_form(const char *command, const brdf_words *given, rgl_form *form)
{
    double alpha = 1, nanometres[RGL_CHANNELS];
    size_t channels = 3, count = 1;
    if (!option_number(command, "--alpha", &given->alpha, 1e-4, 10, &alpha))
        return 0;
    if (given->wavelengths.count)
        channels = parse_numbers(command, "--wavelengths", only_word(&given->wavelengths), 1, 1e6, 1, RGL_CHANNELS,
                                 nanometres);
    for (size_t i = 0; i < channels && given->wavelengths.count; i++) {
        form->wavelength[i] = (float)nanometres[i];
        if (i > 0 && !(form->wavelength[i] > form->wavelength[i - 1]))
            return complain(command, "--wavelengths '%s': they must ascend", only_word(&given->wavelengths)), 0;
    }
    form->alpha = (float)alpha;
    form->channels = (int)channels;
    form->is_spectral = given->wavelengths.count > 0;
    form->f0[0] = 1;
    if (channels > 0 && given->f0.count)
        count = parse_numbers(command, "--f0", only_word(&given->f0), 0, 1, 1, channels, form->f0);
    if (count > 1 && count < channels)
        return complain(command, "--f0 has %zu numbers; 1 or %zu are needed", count, channels), 0;
    for (size_t i = count; i < channels; i++)
        form->f0[i] = form->f0[0];
    return channels > 0 && count > 0;
}

/* ---- work ---------------------------------------------------------------------------------------- */

int export_brdf(const char *command, const brdf_words *given)
{
    rgl_form form = {0};
    chosen_distribution chosen;
    char description[600];
    output_file output;
    if (given->tables.count != 1)
        return complain(command, "%zu distributions are given; --rgl takes one", given->tables.count);
    if (!given->output.count)
        return complain(command, "-o is missing");
    if (!read_form(command, given, &form) || !distribution_open(&chosen, command, given->tables.item[0]))
        return STATUS_USE;
    snprintf(description, sizeof description, "vndf %.500s, alpha %g", given->tables.item[0], (double)form.alpha);
    form.description = description;
    int status = STATUS_USE;
    if (output_open(&output, command, only_word(&given->output))) {
        int written = rgl_write(output.file, chosen.distribution, &form);
        status = written ? output_commit(&output) : output_give_up(&output, "no memory, or no place on the disk");
    }
    distribution_close(&chosen);
    return status;
}
