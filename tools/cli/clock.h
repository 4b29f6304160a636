/* Seconds that pass, and seconds that are worked. */
#ifndef TOOLS_CLI_CLOCK_H
#define TOOLS_CLI_CLOCK_H

/* Of a clock that only goes forward. */
double clock_seconds(void);

/* Of processors, by all threads of this process. */
double clock_processor_seconds(void);

#endif
