"""The fall: a drawn scene becomes settled cables."""
