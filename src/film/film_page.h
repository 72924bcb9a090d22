/* film_page.h -- lines of the page before and behind the data; NULL at the end. */
#ifndef FMDSUB_FILM_FILM_PAGE_H
#define FMDSUB_FILM_FILM_PAGE_H

extern const char *const film_page_before[], *const film_page_behind[];

#endif
