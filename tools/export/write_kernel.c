/* Run by the build: writes the kernel in C, which takes numbers through a pointer, for `vndf bench`. */
#include <stdio.h>

#include "export/document.h"

int main(int argc, char **argv)
{
    export_document document = {.lobes = 1, .count = 1, .kinds = EXPORT_ALL};
    FILE *to = argc == 2 ? fopen(argv[1], "w") : NULL;
    document.as.to = language_named("c");
    document.as.by_pointer = 1;
    if (!to || !translation_prefix(&document.as, "exported") || !document_write(&document, to))
        return 1;
    return fclose(to) != 0;
}
