/* status.c -- see status.h */
#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>

enum status fail(struct report *report, enum status status, const char *format, ...)
{
    if (report && report->status == OK) {
        va_list args;
        va_start(args, format);
        vsnprintf(report->text, sizeof report->text, format, args);
        va_end(args);
        report->status = status;
    }
    return status;
}

enum status trouble_set(struct trouble *why, enum trouble_code code, int index, double value, double t)
{
    if (why) *why = (struct trouble){.code = code, .index = index, .value = value, .t = t};
    return E_NUMERIC;
}
