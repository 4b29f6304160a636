#define _POSIX_C_SOURCE 200809L
#include "draw/page.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "draw/chart.h"
#include "draw/svg.h"
#include "vndf.h"

void page_mark(char mark[PAGE_MARK_MAX], const char *command)
{
    snprintf(mark, PAGE_MARK_MAX, "<meta name=\"generator\" content=\"%s\">", command);
}

void page_name(char made[PAGE_NAME_MAX], const char *of, const char *what)
{
    size_t room = PAGE_NAME_MAX - strlen(what) - 2;
    snprintf(made, PAGE_NAME_MAX, "%.*s", (int)room, of);
    for (char *at = made; *at; at++)
        *at = (char)(isalnum((unsigned char)*at) ? tolower((unsigned char)*at) : '-');
    snprintf(made + strlen(made), PAGE_NAME_MAX - strlen(made), "-%s", what);
}

/* ---- files --------------------------------------------------------------------------------------- */

static FILE *open_file(html_page *page, const char *name)
{
    page_file *file = &page->file[page->count];
    if (page->count == PAGE_FILES_MAX)
        return NULL;
    *file = (page_file){.text = NULL};
    snprintf(file->name, sizeof file->name, "%s", name);
    FILE *stream = open_memstream(&file->text, &file->size);
    page->count += stream != NULL;
    return stream;
}

static int close_file(FILE **stream)
{
    int good = *stream && !ferror(*stream);
    if (*stream && fclose(*stream) != 0)
        good = 0;
    *stream = NULL;
    return good;
}

FILE *page_file_begin(html_page *page, const char *name)
{
    page->data = open_file(page, name);
    return page->data;
}

int page_file_end(html_page *page)
{
    return close_file(&page->data);
}

int page_data_end(html_page *page, const char *what)
{
    const page_file *file = &page->file[page->count - 1];
    if (!page_file_end(page))
        return 0;
    size_t lines = 0;
    for (size_t i = 0; i < file->size; i++)
        lines += file->text[i] == '\n';
    fprintf(page->html,
            "<details class=\"data\"><summary>Data: %s (%zu rows)</summary>\n"
            "<p><a href=\"%s\" download=\"%s\">%s</a></p>\n<pre>",
            what, lines - 1, file->name, file->name, file->name);
    svg_escape(page->html, file->text);
    fputs("</pre></details>\n", page->html);
    return 1;
}

int page_table(html_page *page, text_table t)
{
    int good = table_print_html(page->html, &t);
    table_free(&t);
    return good;
}

int page_data(html_page *page, const char *name, const char *what, text_table t)
{
    FILE *data = page_file_begin(page, name);
    int good = data && table_print_csv(data, &t);
    table_free(&t);
    return good && page_data_end(page, what);
}

/* ---- the page ------------------------------------------------------------------------------------ */

/* The figures of tools/draw/panels.h carry their colours as attributes, so that they also stand alone. On a dark
 * screen the colours on the background are replaced; pictures keep theirs. */
static const char style[] =
    ":root{color-scheme:light dark;--back:#fff;--ink:#212529;--quiet:#495057;--rule:#dee2e6;--good:#00694c;"
    "--bad:#a94a00;--box:#f1f6fb;--link:#005f96}\n"
    "@media screen and (prefers-color-scheme:dark){:root{--back:#16191d;--ink:#e9ecef;--quiet:#b6bec6;"
    "--rule:#3a4149;--good:#5ad6b2;--bad:#f4a06d;--box:#1d2731;--link:#7fbfec}\n"
    ".panel text[fill=\"#212529\"]:not([stroke]){fill:#e9ecef}.panel line[stroke=\"#212529\"]{stroke:#e9ecef}\n"
    ".panel line[stroke=\"#e9ecef\"]{stroke:#343a40}.panel [stroke=\"#1a4f8e\"]{stroke:#7fbfec}\n"
    ".panel circle[stroke=\"#ffffff\"][stroke-width=\"8.0\"]{stroke:#16191d}}\n"
    "*{box-sizing:border-box}\n"
    "body{font:16px/1.5 'Helvetica Neue',Arial,'DejaVu Sans',sans-serif;color:var(--ink);background:var(--back);"
    "max-width:1180px;margin:0 auto;padding:24px}\n"
    "h1{font-size:1.7em;margin:0 0 .2em}h2{font-size:1.3em;margin:2.2em 0 .2em;padding-top:.6em;"
    "border-top:1px solid var(--rule)}h3{font-size:1.05em;margin:1.4em 0 .4em}\n"
    "p{margin:.4em 0}.lead,figcaption,.note{color:var(--quiet)}figcaption,.note{font-size:.9em}\n"
    "img{max-width:100%;height:auto}"
    ".pixels{image-rendering:pixelated}a{color:var(--link)}nav a{margin-right:1em;white-space:nowrap}\n"
    ".advice{background:var(--box);border-left:4px solid var(--link);padding:.6em 1em;margin:1em 0}\n"
    ".scroll{overflow-x:auto}table{border-collapse:collapse;margin:.8em 0;font-variant-numeric:tabular-nums}\n"
    "th,td{padding:.25em .7em;text-align:right;border-bottom:1px solid var(--rule);white-space:nowrap}\n"
    "th:first-child,td:first-child{text-align:left}th{font-weight:600;vertical-align:bottom;white-space:pre-line}\n"
    "tr.chosen td{font-weight:600;background:var(--box)}.no{color:var(--bad)}.yes{color:var(--good)}\n"
    "figure{margin:1em 0;flex:1 1 480px;min-width:0;max-width:100%}figure svg{max-width:100%;height:auto}\n"
    ".panels{display:flex;flex-wrap:wrap;gap:0 8px;align-items:flex-start}\n"
    ".pair{display:flex;flex-wrap:wrap;gap:0 24px}\n"
    ".data{margin:.4em 0;font-size:.9em}.data pre{max-height:24em;overflow:auto;border:1px solid var(--rule);"
    "padding:.6em}summary{cursor:pointer;color:var(--quiet)}\n"
    "@media screen{.wide svg.chart[role]{min-width:760px}}@media (max-width:600px){body{padding:12px}}\n"
    "@page{size:A4 landscape;margin:12mm}\n"
    "@media print{:root{color-scheme:light}body{font-size:10pt;max-width:none;padding:0}.data,nav{display:none}\n"
    ".scroll{overflow:visible}h2{margin-top:1em}h2,h3,.lead{break-after:avoid}"
    "figure,table,.advice,.lead{break-inside:avoid}.panels{flex-wrap:nowrap}.panels svg{min-width:0;flex:0 1 auto}"
    ".wide svg[role]{max-height:145mm}"
    ".pair figure{flex:1 1 30%}a{color:inherit}}\n"
    "code{font-family:ui-monospace,'DejaVu Sans Mono',monospace;font-size:.92em;overflow-wrap:anywhere}\n";

int page_begin(html_page *page, const char *command, const char *title)
{
    char mark[PAGE_MARK_MAX];
    *page = (html_page){.command = command};
    page_mark(mark, command);
    page->html = open_file(page, "index.html");
    if (!page->html)
        return 0;
    fprintf(page->html,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n%s\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
            mark);
    svg_escape(page->html, title);
    fputs("</title>\n<style>\n", page->html);
    fputs(style, page->html);
    chart_style(page->html);
    fputs("</style>\n</head>\n<body>\n<h1>", page->html);
    svg_escape(page->html, title);
    fputs("</h1>\n", page->html);
    return 1;
}

int page_end(html_page *page)
{
    fprintf(page->html, "<p class=\"note\">Made by <code>%s</code>, vndf " VNDF_VERSION ".</p>\n", page->command);
    fputs("</body>\n</html>\n", page->html);
    return close_file(&page->html);
}

void page_free(html_page *page)
{
    close_file(&page->data);
    close_file(&page->html);
    for (size_t i = 0; i < page->count; i++)
        free(page->file[i].text);
    page->count = 0;
}

void page_section(html_page *page, const char *id, const char *title, const char *lead)
{
    fprintf(page->html, "<section id=\"%s\">\n<h2>", id);
    svg_escape(page->html, title);
    fputs("</h2>\n<p class=\"lead\">", page->html);
    svg_escape(page->html, lead);
    fputs("</p>\n", page->html);
}

void page_section_end(html_page *page)
{
    fputs("</section>\n", page->html);
}
