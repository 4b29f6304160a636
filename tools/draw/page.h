/* The page: a head with its style, sections with a title, and the data behind each plot, in a file beside the page
 * and again inside it. Memory holds the whole page until all files are written together. */
#ifndef TOOLS_DRAW_PAGE_H
#define TOOLS_DRAW_PAGE_H

#include <stddef.h>
#include <stdio.h>

#include "draw/table.h"

enum { PAGE_FILES_MAX = 64, PAGE_NAME_MAX = 64 };

typedef struct page_file {
    char name[PAGE_NAME_MAX];
    char *text; /* owned */
    size_t size;
} page_file;

typedef struct html_page {
    const char *command;            /* makes the page */
    FILE *html;                     /* the page goes here */
    page_file file[PAGE_FILES_MAX]; /* the first is the page itself */
    size_t count;
    FILE *data; /* open between page_file_begin and its end */
} html_page;

/* OF-WHAT, the name of a file beside the page: hyphens replace all but letters and digits of `of`. */
void page_name(char made[PAGE_NAME_MAX], const char *of, const char *what);

/* The mark near the beginning of a page that names its `command`; needs PAGE_MARK_MAX bytes. */
enum { PAGE_MARK_MAX = 96 };
void page_mark(char mark[PAGE_MARK_MAX], const char *command);

/* Returns 0 if there is no memory; call page_free in any case. */
int page_begin(html_page *page, const char *command, const char *title);
int page_end(html_page *page);
void page_free(html_page *page);

/* A heading with a line or two below it; both are plain text. */
void page_section(html_page *page, const char *id, const char *title, const char *lead);
void page_section_end(html_page *page);

/* Begins a new file beside the page, for the caller to fill; NULL if there is no memory. */
FILE *page_file_begin(html_page *page, const char *name);
int page_file_end(html_page *page);

/* Ends the file; the page links it and shows it inside, folded. */
int page_data_end(html_page *page, const char *what);

/* A table in the page, and as CSV a whole file of data; it is freed. 0 if there is no memory. */
int page_table(html_page *page, text_table t);
int page_data(html_page *page, const char *name, const char *what, text_table t);

#endif
