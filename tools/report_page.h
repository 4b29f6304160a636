/* The page: head with style, sections with a title, and the data behind each plot, which stands as a file beside
 * the page and once more inside it. All of it is held in memory until it is written at once. */
#ifndef TOOLS_REPORT_PAGE_H
#define TOOLS_REPORT_PAGE_H

#include <stddef.h>
#include <stdio.h>

enum { REPORT_FILES_MAX = 12 };

typedef struct report_file {
    const char *name;
    char *text; /* owned */
    size_t size;
} report_file;

typedef struct report_page {
    FILE *html;       /* to write to */
    report_file file[REPORT_FILES_MAX]; /* the first is the page itself */
    size_t count;
    FILE *data;       /* open between page_data_begin and page_data_end */
} report_page;

/* By this line, near its beginning, a page is known as one of ours. */
extern const char page_mark[];

/* 0 if there is no memory; page_free is due in any case. */
int page_begin(report_page *page, const char *title);
int page_end(report_page *page);
void page_free(report_page *page);

/* A heading with a line or two below it; both are plain text. */
void page_section(report_page *page, const char *id, const char *title, const char *lead);
void page_section_end(report_page *page);

/* A new file beside the page, to be filled with rows; NULL if there is no memory. */
FILE *page_file_begin(report_page *page, const char *name);
int page_file_end(report_page *page);

/* A field between quotes. */
void page_field(FILE *data, const char *text);

/* The same for data: it is linked and shown inside the page, folded. */
int page_data_end(report_page *page, const char *what);

#endif
