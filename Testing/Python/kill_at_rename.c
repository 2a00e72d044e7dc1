/* SPDX-License-Identifier: BSD-3-Clause
   For LD_PRELOAD: counts the renames of a process, and kills it right before the one that was asked for. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

static int Left = 0;
static int Count = 0;

/* From now on the n-th rename is the end of this process; 0: none is. Returns how many there were. */
int WaftKillAtRename(int n)
{
  const int count = Count;
  Left = n;
  Count = 0;
  return count;
}

static void Tick(void)
{
  ++Count;
  if (Left > 0 && --Left == 0)
  {
    kill(getpid(), SIGKILL);
  }
}

int rename(const char* from, const char* to)
{
  Tick();
  int (*next)(const char*, const char*) = dlsym(RTLD_NEXT, "rename");
  return next(from, to);
}

int renameat2(int fromFolder, const char* from, int toFolder, const char* to, unsigned int flags)
{
  Tick();
  int (*next)(int, const char*, int, const char*, unsigned int) = dlsym(RTLD_NEXT, "renameat2");
  return next(fromFolder, from, toFolder, to, flags);
}

int renameat(int fromFolder, const char* from, int toFolder, const char* to)
{
  Tick();
  int (*next)(int, const char*, int, const char*) = dlsym(RTLD_NEXT, "renameat");
  return next(fromFolder, from, toFolder, to);
}
