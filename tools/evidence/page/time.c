/* What a caller pays: every row that was measured, with the file that `vndf bench` would write. */
#include <stdio.h>

#include "evidence/page/report.h"

int report_times(html_page *page, const report *r)
{
    page_section(page, "time", "What a sample costs",
                 "Nanoseconds that a caller pays for view, sample and density: medians over turns in which all "
                 "methods run one after the other, one thread, data in cache. Time hardly depends on D.");
    int good = evidence_print_html(page->html, &r->rows);
    FILE *data = good ? page_file_begin(page, "methods.csv") : NULL;
    good = data && evidence_print(data, &r->rows, FIGURES_CSV) &&
           page_data_end(page, "all methods, as vndf bench -o FILE.csv has them");
    page_section_end(page);
    return good;
}
