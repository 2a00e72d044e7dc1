# SPDX-License-Identifier: BSD-3-Clause
"""Objects by their full names, which tell doubles that were linked from other files apart."""


def by_name(things):
    """{full name: object}"""
    return {thing.name_full: thing for thing in things}
