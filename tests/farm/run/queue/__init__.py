"""Tests of the messages in Redis, with real servers."""
