/* vndf explore: a page on which tables, GGX and Beckmann are seen side by side, drawn by the exported kernel. */
#include "cli/arguments.h"
#include "cli/output.h"
#include "command.h"
#include "commands/parts/named_tables.h"
#include "export/page/explorer.h"

static const char name[] = "vndf explore";

static const char help[] =
    "usage: vndf explore FILE... -o PAGE.html\n"
    "\n"
    "Writes one page that needs nothing else, not even a network: in a browser with WebGL2 it draws two spheres, each\n"
    "shaded by sampling the visible normals of a table, of GGX or of Beckmann; beside each the density of these\n"
    "normals with samples on top, what the samples measure, and D of all of them as curves. Roughness, its axes,\n"
    "the angle of incidence, material and light can be changed. The shader is what `vndf export --language glsl`\n"
    "writes, and the page shows it.\n"
    "\n"
    "  -o PAGE.html     the page; - for stdout\n"
    "\n"
    "Settings stand in the page's address, so that a link keeps them: PAGE.html#alpha=0.2,0.05&theta=70&light=lamp;\n"
    "#frames=64 draws that many samples per pixel before the page is shown, for pictures.\n"
    "\n"
    "exit status: 0 good, 2 wrong use\n"
    "\n"
    "example: vndf explore tables/student-t-2.5.vndf tables/hazy.vndf -o normals.html\n";

static int run(const words *files, const char *path, export_document *document)
{
    output_file page;
    translation_prefix(&document->as, "vndf");
    if (!named_tables_open(name, files, 0, document))
        return STATUS_USE;
    if (document->count > EXPLORER_NUMBERS_MAX)
        return complain(name, "the tables have %zu numbers, and a texture of WebGL2 holds %d", document->count,
                        EXPLORER_NUMBERS_MAX);
    if (!output_open(&page, name, path))
        return STATUS_USE;
    return explorer_write(document, page.file) ? output_commit(&page) : output_give_up(&page, "no memory");
}

int command_explore(int argc, char **argv)
{
    words files = {{NULL}, 0}, output = {{NULL}, 0};
    const option_form options[] = {{"-o", 1, 1, &output}};
    const command_form form = {name, help, options, 1, "FILE", 1, EXPORT_TABLES_MAX};
    export_document document = {.as = {.to = language_named("glsl")}, .lobes = 1, .kinds = EXPORT_ALL};
    int status = parse_arguments(&form, argc, argv, &files);
    if (status == PARSE_GO_ON && !output.count)
        return complain(name, "-o is missing");
    if (status == PARSE_GO_ON)
        status = run(&files, only_word(&output), &document);
    named_tables_close(&document);
    return status;
}
