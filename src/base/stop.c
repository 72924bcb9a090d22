/* stop.c -- see stop.h */
#include "base/stop.h"

volatile sig_atomic_t stop;

enum status stop_status(void)
{
    return stop == SIGINT ? E_SIGINT : stop == SIGTERM ? E_SIGTERM : stop ? E_LIMIT : OK;
}
