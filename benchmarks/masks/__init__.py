"""Masks against white-on-black Cycles renders of many samples."""
