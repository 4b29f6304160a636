#include "commands/parts/named_tables.h"

#include <stdlib.h>
#include <string.h>

static int is_named_before(const export_document *document, const exported_table *table)
{
    static const char *const taken[] = {"GGX",  "BECKMANN", "LOBES", "NUMBERS", "KERNEL", "HEAD",
                                        "KNOT", "LAW",      "MORE",  "TAIL",    "LOW",    "LAW_TERMS"};
    for (size_t i = 0; i < sizeof taken / sizeof taken[0]; i++)
        if (strcmp(taken[i], table->name) == 0)
            return 1;
    for (const exported_table *t = document->table; t < table; t++)
        if (strcmp(t->name, table->name) == 0)
            return 1;
    return 0;
}

static int open_table(const char *command, export_document *document, chosen_distribution *chosen,
                      const char *file)
{
    exported_table *table = &document->table[document->tables];
    if (!distribution_open(chosen, command, file))
        return 0;
    table->distribution = chosen->distribution;
    table->file = file;
    table->size = vndf_numbers(table->distribution, NULL, 0);
    table->base = document->count;
    document->tables++;
    document->count += table->size;
    if (table->size == 0)
        complain(command, "'%s' is a closed form: every kernel has it", file);
    else if (!document_name_table(table) || is_named_before(document, table))
        complain(command, "'%s': its constant would be %s%s, which is taken; rename the file", file,
                 document->as.upper, table->name);
    else if (document->count > (size_t)1 << 24)
        complain(command, "'%s': the tables have more than 2^24 numbers, which a float cannot count", file);
    else
        return 1;
    return 0;
}

int named_tables_open(named_tables *tables, const char *command, const words *files, export_document *document)
{
    int good = 1;
    tables->count = 0;
    for (size_t i = 0; good && i < files->count; i++) {
        tables->chosen[tables->count].owned = NULL;
        good = open_table(command, document, &tables->chosen[tables->count++], files->item[i]);
    }
    return good;
}

int named_tables_numbers(const char *command, export_document *document)
{
    document->numbers = malloc((document->count + 1) * sizeof *document->numbers);
    if (!document->numbers) {
        complain(command, "no memory");
        return 0;
    }
    for (size_t i = 0; i < document->tables; i++) {
        const exported_table *t = &document->table[i];
        vndf_numbers(t->distribution, document->numbers + t->base, t->size);
    }
    return 1;
}

void named_tables_close(named_tables *tables, export_document *document)
{
    for (size_t i = 0; i < tables->count; i++)
        distribution_close(&tables->chosen[i]);
    free(document->numbers);
    document->numbers = NULL;
}
