#include "commands/parts/named_tables.h"

#include <stdlib.h>

#include "cli/files.h"
#include "cli/subject.h"

int named_tables_open(const char *command, const words *files, int families, export_document *document)
{
    for (size_t i = 0; i < files->count; i++) {
        const char *file = files->item[i];
        chosen_distribution chosen;
        if (!distribution_open(&chosen, command, file, families))
            return 0;
        if (!chosen.owned && !chosen.family)
            continue; /* a closed form, which every kernel has */
        const int added = document_add(document, input_name(file), chosen.owned, chosen.family);
        if (added < 0)
            return denied(command, "no memory");
        if (!added)
            return denied(command, "'%s': its constant would be %s%s, which is taken; rename the file", file,
                          document->upper, document->table[i].name);
        if (document->count > (size_t)1 << 24)
            return denied(command, "'%s': the tables have more than 2^24 numbers, which a float cannot count",
                          file);
    }
    if (!document->count) { /* no language has an array of no numbers */
        document->numbers = calloc(1, sizeof *document->numbers);
        document->count = 1;
    }
    return document->numbers || denied(command, "no memory");
}

void named_tables_close(export_document *document)
{
    for (size_t i = 0; i < document->tables; i++) {
        vndf_free(document->table[i].distribution);
        vndf_family_free(document->table[i].family);
    }
    free(document->numbers);
}
