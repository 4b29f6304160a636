/* vndf info: what a file of this program says of itself; nothing is measured (`vndf check` does). */

#include "command.h"
#include "commands/parts/describe.h"
#include "cli/output.h"

static const char *const help[] = {
    "usage: vndf info FILE|ggx|beckmann|FILE.vndfs\n"
    "\n"
    "Prints lines of a name, a value and its unit; FILE is - for a table on stdin. Of a table:\n"
    "\n"
    "  source, tool   how it was made, as arguments of `vndf build`, and by which version\n"
    "  bytes, memory  of the file, and when it is loaded; closed forms have 0\n"
    "  cells, moments    intervals of the slope length before the tail; 2, 3 or 4 as in vndf build --moments\n"
    "  normalization  the factor by which the given D or P22 was multiplied\n"
    "  scale          median slope length at alpha = 1\n"
    "\n"
    "its certificate, measured when it was made, over incident directions from 0 to 180 degrees:\n"
    "\n"
    "  tv, tv_theta   largest total variation distance between sampled and true visible normals, and where\n"
    "  tv_above, tv_above_theta    the same for directions from 0 to 90 degrees\n"
    "  max_weight     largest true/sampled density over all but 1e-6 of the mass\n"
    "  weight_bounded  yes if true/sampled is bounded everywhere\n"
    "  area_error     largest relative error of the projected area, Lambda and G1\n"
    "  consistency    largest |integral of pdf - 1|\n"
    "  ndf_error      largest relative error of ndf over all but 1e-6 of the mass\n"
    "  hidden         part of the mass, or of the area at grazing incidence, that the builder may have missed\n"
    "  finest         0 if that is proven; else the relative width of slope down to which D was sampled\n"
    "  horizon_power  p < 0 where D grows as cos(theta_m)^p towards the horizon: no angular grid resolves it\n"
    "  floor_above, floor    what is left of tv_above and of tv at any size, with these moments\n"
    "\n"
    "what a measurement noted of it (tools/measured/README.md), and a verdict, made from all that. Of a family of\n"
    "tables (vndf build --parameter), a mixture of neighbours between its knots:\n"
    "\n"
    "  knots          the number of tables, from the parameter `low` to `high`\n"
    "  linear_in      p or 1/p: what the weights of neighbours are linear in\n"
    "  distance, grazing    largest total variation between family and mixture: of slopes, of normals at grazing\n"
    "                 incidence, without tables; tables_tv is that of the tables\n"
    "  knot           a line for each table, distance up to the next knot\n"
    "\n"
    "example: vndf info wavy.vndf\n"
    "         vndf info wavy.vndf --json\n",
    NULL};

static int run(const arguments *given)
{
    const char *name = given->positional.item[0];
    chosen_distribution chosen;
    if (!distribution_open(&chosen, given->command, name, 1))
        return STATUS_USE;
    figures f = figures_begin(given);
    describe(&f, &chosen);
    const int status = figures_end(&f);
    distribution_close(&chosen);
    return status;
}

const subcommand command_info = {
    "vndf info", "what a table is, where it came from, its certificate", "FILE|ggx|beckmann|FILE.vndfs", 1, 1, run,
    help};
