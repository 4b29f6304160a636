#include "bench/cells.h"

#include <math.h>
#include <string.h>

void cell_number(char cell[CELL], const char *format, double x)
{
    if (isnan(x))
        snprintf(cell, CELL, "-");
    else
        snprintf(cell, CELL, format, x);
}

void cell_time(char cell[CELL], double ns)
{
    cell_number(cell, ns < 10 ? "%.2f" : "%.1f", ns);
}

int cell_wider(int width, const char *text)
{
    int length = (int)strlen(text);
    return length > width ? length : width;
}

void csv_text(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++)
        fputs(*text == '"' ? "\"\"" : (char[]){*text, '\0'}, file);
    fputc('"', file);
}

void csv_number(FILE *file, double x)
{
    if (isnan(x))
        fputs(",", file);
    else
        fprintf(file, ",%.6g", x);
}

void markdown_text(FILE *file, const char *text)
{
    for (; *text; text++)
        fputs(*text == '|' ? "\\|" : (char[]){*text, '\0'}, file);
}
