#include "commands/parts/export_brdf.h"

#include <stdio.h>

#include "cli/output.h"
#include "cli/subject.h"
#include "command.h"
#include "measured/brdf.h"

/* ---- words --------------------------------------------------------------------------------------- */

/* Roughness, wavelengths, and F0: one number for all channels, or one for each. */
static int read_form(const arguments *given, rgl_form *form)
{
    const char *command = given->command, *wavelengths = option_value(given, "--wavelengths");
    const char *f0 = option_value(given, "--f0");
    double alpha = 1, nanometres[RGL_CHANNELS];
    size_t channels = 3, count = 1;
    if (!option_number(given, "--alpha", 1e-4, 10, &alpha))
        return 0;
    if (wavelengths)
        channels = parse_numbers(command, "--wavelengths", wavelengths, 1, 1e6, 1, RGL_CHANNELS, nanometres);
    for (size_t i = 0; i < channels && wavelengths; i++) {
        form->wavelength[i] = (float)nanometres[i];
        if (i > 0 && !(form->wavelength[i] > form->wavelength[i - 1]))
            return complain(command, "--wavelengths '%s': they must ascend", wavelengths), 0;
    }
    form->alpha = (float)alpha;
    form->channels = (int)channels;
    form->is_spectral = wavelengths != NULL;
    form->f0[0] = 1;
    if (channels > 0 && f0)
        count = parse_numbers(command, "--f0", f0, 0, 1, 1, channels, form->f0);
    if (count > 1 && count < channels)
        return complain(command, "--f0 has %zu numbers; 1 or %zu are needed", count, channels), 0;
    for (size_t i = count; i < channels; i++)
        form->f0[i] = form->f0[0];
    return channels > 0 && count > 0;
}

/* ---- work ---------------------------------------------------------------------------------------- */

int export_brdf(const arguments *given)
{
    const char *command = given->command;
    rgl_form form = {0};
    chosen_distribution chosen;
    char description[600];
    output_file output;
    if (given->positional.count != 1)
        return complain(command, "%zu distributions are given; --rgl takes one", given->positional.count);
    if (!read_form(given, &form) || !distribution_open(&chosen, command, given->positional.item[0], 0))
        return STATUS_USE;
    snprintf(description, sizeof description, "vndf %.500s, alpha %g", given->positional.item[0],
             (double)form.alpha);
    form.description = description;
    int status = STATUS_USE;
    if (output_open(&output, command, option_value(given, "-o"))) {
        int written = rgl_write(output.file, chosen.distribution, &form);
        status = written ? output_commit(&output) : output_give_up(&output, "no memory, or no place on the disk");
    }
    distribution_close(&chosen);
    return status;
}
