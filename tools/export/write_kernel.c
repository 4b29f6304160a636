/* Run by the build: writes the kernel in C, which takes numbers through a pointer, for `vndf bench`; or in Python for
 * tools/python, where the name of the file ends in .py. */
#include <string.h>

#include "export/export.h"

int main(int argc, char **argv)
{
    const size_t n = argc == 2 ? strlen(argv[1]) : 0;
    const int is_python = n > 3 && strcmp(argv[1] + n - 3, ".py") == 0;
    export_document document = {.to = language_named(is_python ? "python" : "c"), .lobes = 1};
    FILE *to = n ? fopen(argv[1], "w") : NULL;
    if (is_python)
        document.only =
            "frame placed view_from sample pdf ndf area drawn_area lobe_numbers lobe_shares mixture_pdf VNDF_HEAD "
            "VNDF_STRIDE";
    return !to || !document_prefix(&document, is_python ? "vndf" : "exported") ||
           !document_write(&document, to, NULL) || fclose(to) != 0;
}
