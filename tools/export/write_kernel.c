/* Run by the build: writes the kernel in C, which takes numbers through a pointer, for `vndf bench`; or in Python for
 * tools/python, where the name of the file ends in .py. */
#include <stdio.h>
#include <string.h>

#include "export/document.h"

int main(int argc, char **argv)
{
    export_document document = {.lobes = 1, .count = 1, .kinds = EXPORT_ALL};
    FILE *to = argc == 2 ? fopen(argv[1], "w") : NULL;
    document.bare = argc == 2 && strlen(argv[1]) > 3 && strcmp(argv[1] + strlen(argv[1]) - 3, ".py") == 0;
    document.as.to = language_named(document.bare ? "python" : "c");
    document.as.by_pointer = !document.bare;
    if (document.bare)
        document.only =
            "frame ggx_see ggx_draw ggx_density ggx_area ggx_p22 beckmann_see beckmann_draw beckmann_area "
            "beckmann_density beckmann_p22 table_view_of table_draw table_pdf table_given table_p22 law_area";
    if (!to || !translation_prefix(&document.as, document.bare ? "vndf" : "exported") ||
        !document_write(&document, to, NULL))
        return 1;
    return fclose(to) != 0;
}
